#pragma once

#include <cstdint>

namespace peregrine::base {

// Told now and then how far long work has come, from the thread that asked for it alone; a return
// other than 0 asks the work to stop.
struct Progress {
    int32_t (*function)(void* user, float fraction) = nullptr;
    void* user = nullptr;

    bool cancels(float fraction) const { return function && function(user, fraction) != 0; }
};

// A part of longer work: its fractions as those of the whole.
class PartProgress {
public:
    PartProgress(const Progress& whole, float begin, float share)
        : whole_(whole), begin_(begin), share_(share) {}

    Progress progress() { return {whole_.function ? tell : nullptr, this}; }

private:
    static int32_t tell(void* user, float fraction) {
        const auto& part = *static_cast<const PartProgress*>(user);
        return part.whole_.function(part.whole_.user, part.begin_ + part.share_ * fraction);
    }

    Progress whole_;
    float begin_, share_;
};

} // namespace peregrine::base
