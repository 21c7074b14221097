#pragma once

#include "../durations.h"
#include "../level.h"
#include "../stage.h"
#include "../upload.h"
#include "pose.h"
#include "skinning.h"

namespace host {

// What the steps of an animated frame took.
struct PlayerLog {
    Durations pose, skinning, update, commit;
};

// Plays a level's animations: time -> pose -> meshes and lights -> calls of the engine -> commit.
// The level must outlive it. Throws EngineError.
class Player {
public:
    Player(Stage& stage, const Level& level, Uploaded uploaded);

    bool animated() const { return !level_.rig.clips.empty(); }
    double time() const { return time_; } // of the last moment described

    // Describes a moment to the engine, in seconds, not negative. The caller has to commit it;
    // false if nothing changes. The first time, rigid meshes are put where they belong.
    bool describe(double seconds);

    // Describes a moment and commits it, if anything changes, or has.
    void show(double seconds, rt_structure structure, rt_build_quality quality,
              bool changed = false);

    // A camera of the level as it is now.
    Viewpoint follow(const Viewpoint& camera) const;

    const Uploaded& uploaded() const { return uploaded_; }
    const PlayerLog& log() const { return log_; }

private:
    // What the engine was last told.
    struct Placed {
        rt_mesh mesh;
        uint32_t node;
        glm::dmat4 world;
        bool told = false, hidden = false;
    };
    struct Deformed {
        std::vector<glm::mat4x3> joints;
        std::vector<double> weights;
        Shape shape;
        bool changed = false;
    };

    void deform_meshes();
    bool update_deformed();
    bool move_rigid();
    void move(Placed& placed) const;
    bool move_lights();

    Stage& stage_;
    const Level& level_;
    Uploaded uploaded_;
    Pose pose_;
    std::vector<Placed> placed_;
    std::vector<Deformed> deformed_;
    std::vector<Light> lights_;
    PlayerLog log_;
    double time_ = 0.0;
};

} // namespace host
