// The fixture of the tests that hand nonsense to the door.
#pragma once

#include "support.h"

#include <cmath>
#include <limits>

namespace peregrine::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

class BadInput : public testing::Test {
protected:
    BadInput() : before_(answers(world_->scene)), stats_(stats()) {}

    // After a refused call nothing that was described or committed has changed.
    ~BadInput() override {
        EXPECT_EQ(answers(world_->scene), before_);
        expect_unchanged();
        EXPECT_OK(rt_commit_scene(world_->scene, nullptr, nullptr));
        EXPECT_EQ(answers(world_->scene), before_) << "the next commit shows it";
    }

    // The call was refused with this code and a sentence that has these words in it.
    void expect_refused(rt_result result, rt_result expected, const std::string& words) {
        EXPECT_EQ(result, expected) << describe(result);
        const std::string sentence = rt_get_last_error();
        EXPECT_NE(sentence.find(words), std::string::npos)
            << "\"" << sentence << "\" does not say \"" << words << "\"";
        expect_unchanged();
    }

    void expect_unchanged() {
        const rt_scene_stats now = stats();
        EXPECT_EQ(now.mesh_count, stats_.mesh_count);
        EXPECT_EQ(now.material_count, stats_.material_count);
        EXPECT_EQ(now.texture_count, stats_.texture_count);
        EXPECT_EQ(now.light_count, stats_.light_count);
        EXPECT_EQ(now.snapshot_version, stats_.snapshot_version);
    }

    rt_scene_stats stats() {
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats(world_->scene, &stats));
        return stats;
    }

    rt_scene scene() { return world_->scene; }

    WorldGuard world_;

private:
    Bytes before_;
    rt_scene_stats stats_;
};

// What an out-parameter holds before a call that must not write it.
template <class Handle>
inline constexpr Handle kUntouched = {0xabcd, 0xef01};

template <class Handle>
bool untouched(Handle handle) {
    return handle.index == 0xabcd && handle.generation == 0xef01;
}

} // namespace peregrine::test
