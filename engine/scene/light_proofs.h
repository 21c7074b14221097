#pragma once

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "scene/light_view.h"
#include "trace/visibility/prove.h"

#include <chrono>
#include <memory>
#include <optional>
#include <span>

namespace peregrine::scene {

// Proofs for lights over the same fixed triangles. They may go on from commit to commit.
class LightProofs {
public:
    using Clock = std::chrono::steady_clock;
    using AllCorners = base::Vector<trace::visibility::Corners>;

    LightProofs(std::shared_ptr<const Geometry> geometry, AllCorners corners, float patch_size,
                base::Memory* memory);
    LightProofs(const LightProofs&) = delete; // its tree refers to its corners
    LightProofs& operator=(const LightProofs&) = delete;

    bool are_of(const std::shared_ptr<const Geometry>& geometry, float patch_size) const {
        return geometry_ == geometry && patch_size_ == patch_size;
    }

    struct Wanted {
        uint32_t slot; // of the light, ascending
        uint32_t generation;
        trace::visibility::Lamp lamp;
    };
    // From here on it is about these lights. What was begun of them goes on. All that is proved of
    // new ones gets at most so many bytes.
    void want(std::span<const Wanted> wanted, uint64_t most_bytes);

    // Goes on until the deadline, but somewhat in any case. Throws base::Error cancelled.
    void run(const std::optional<Clock::time_point>& deadline, base::Scheduler& scheduler,
             const base::Progress& progress);

    // Null as long as it is not all proved.
    std::shared_ptr<const trace::visibility::PointVisibility> result(uint32_t slot) const;
    uint32_t waiting() const;
    uint64_t proof_count() const; // tried so far

private:
    struct Job {
        Wanted wanted;
        trace::visibility::LampProof proof;
        bool is_done = false;
    };

    std::shared_ptr<const Geometry> geometry_;
    float patch_size_;
    base::Memory* memory_;
    AllCorners corners_;
    trace::visibility::TriangleTree tree_;
    base::Vector<Job> jobs_; // by slot
};

} // namespace peregrine::scene
