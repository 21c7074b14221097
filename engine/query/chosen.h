#pragma once

#include "query/query.h"

#include <array>

namespace peregrine::query {

// A selection in the kernels' terms, without its list of ignored meshes.
trace::Filter filter_of(const scene::Snapshot& snapshot, const Selection& selection);

// ... with it: has the slots that the filter points to.
class Chosen {
public:
    Chosen(const scene::Snapshot& snapshot, const Selection& selection);
    Chosen(const Chosen&) = delete;
    Chosen& operator=(const Chosen&) = delete;

    const trace::Filter& filter() const { return filter_; }

private:
    void ignore(const scene::Snapshot& snapshot, std::span<const base::Handle> meshes);

    static constexpr size_t kRoom = 32; // lists up to this length allocate nothing

    trace::Filter filter_;
    std::array<uint32_t, kRoom> room_;
    base::Vector<uint32_t> longer_;
};

} // namespace peregrine::query
