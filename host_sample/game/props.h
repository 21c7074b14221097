#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "../level.h"
#include "../stage.h"

namespace host::game {

// A thing that is only to be seen: meshes that stand together.
struct Prop {
    struct Piece {
        rt_mesh mesh{}; // hidden: what is seen are instances of it
        glm::dmat4 place{1.0};
    };
    std::vector<Piece> pieces;
};

struct Props {
    Prop drone, drone_off; // look along -Z
    Prop core, grenade;
    Prop bolt; // flies along -Z
};

// From nodes of these names, each at its own origin. Throws InputError or EngineError.
Props find_props(Stage& stage, const Level& level); // whose nodes are all rigid
Props load_props(Stage& stage, const std::filesystem::path& path);

// As many instances of a prop as are wanted at a time. Seen after the next commit.
class PropPool {
public:
    PropPool(Stage& stage, Prop prop) : stage_(stage), prop_(std::move(prop)) {}

    // Shows it at these places and nowhere else.
    void show(std::span<const glm::dmat4> places);

private:
    struct Instance {
        std::vector<rt_mesh> meshes; // one a piece
        bool shown = false;
    };
    void grow();
    void set_shown(Instance& instance, bool shown);

    Stage& stage_;
    Prop prop_;
    std::vector<Instance> instances_;
};

} // namespace host::game
