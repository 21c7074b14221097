#pragma once

#include <string>

#include <glm/gtc/quaternion.hpp>

#include "../mesh.h"
#include "track.h"

// What moves in a level: plain data that knows neither the file format nor the engine.
namespace host {

struct Local {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

// A node's space is its parent's times `before` times, where tracks drive it, `rest` as they
// change it.
struct RigNode {
    std::string name;
    uint32_t parent = no_index; // an earlier node; none: the world
    glm::dmat4 before{1.0};
    bool driven = false;
    Local rest;
    std::vector<double> weights; // of morph targets, at rest
};

struct Rig {
    std::vector<RigNode> nodes;
    std::vector<Clip> clips; // play together; each loops in its own time
};

// Moves as a whole. Its vertices are in the space of each of its nodes.
struct RigidMesh {
    Mesh mesh;
    std::vector<uint32_t> nodes;    // of the rig: it stands at each of them
    std::vector<glm::dmat4> places; // where it stands as well, and nothing moves it

    size_t count() const { return nodes.size() + places.size(); } // never 0
};

struct Joint {
    uint32_t node = 0; // of the rig
    glm::dmat4 inverse_bind{1.0};
};

struct Influence {
    uint32_t joint = 0; // of the mesh
    float weight = 0.0f;
};

// What full weight adds to each vertex. Arrays are empty or as long as the mesh's positions.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

// Its vertices are morphed, then each follows its joints.
struct DeformingMesh {
    Mesh mesh; // before both
    std::vector<MorphTarget> targets;
    uint32_t node = 0; // of the rig: whose weights the targets take
    std::vector<Joint> joints;
    std::vector<Influence> influences;     // those of a vertex sum to 1
    std::vector<uint32_t> first_influence; // one a vertex, and the end; without any it stays

    size_t vertex_count() const { return mesh.positions.size(); }
};

} // namespace host
