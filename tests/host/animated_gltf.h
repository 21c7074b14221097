#pragma once

#include <cmath>

#include "gltf_builder.h"

namespace host::test {

inline const float half_root = std::sqrt(0.5f); // sine and cosine of 45 degrees

// Adds a channel and its sampler to animation 0 or another.
inline void add_channel(GltfBuilder& builder, int node, const char* path, const char* interpolation,
                        const std::vector<float>& times, const std::vector<float>& values,
                        int components, size_t animation = 0) {
    const char* type = components == 1 ? "SCALAR" : components == 3 ? "VEC3" : "VEC4";
    Json& animations = builder.json["animations"];
    while (animations.size() <= animation)
        animations.push_back({{"channels", Json::array()}, {"samplers", Json::array()}});
    const int input = builder.add_accessor(times, 5126, "SCALAR", 1);
    const int output = builder.add_accessor(values, 5126, type, components);
    Json& target = builder.json["animations"][animation];
    target["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", interpolation}});
    target["channels"].push_back(
        {{"sampler", target["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

// Seen from above at the times 0, 1 and 2: a door of one metre that opens by a quarter turn.
//
//   hinge (10, 0, 0) ----- door    hinge             hinge
//                                    \                 |
//                                      \ door          | door, towards -Z
//
// Nodes: 0 the door, 1 the frame that holds it; both triangles as in make_quad().
inline GltfBuilder make_door() {
    GltfBuilder builder = make_quad();
    builder.push("nodes", {{"translation", {10, 0, 0}}, {"children", {0}}});
    builder.json["scenes"][0]["nodes"] = {1};
    add_channel(builder, 0, "rotation", "LINEAR", {0, 2}, {0, 0, 0, 1, 0, half_root, 0, half_root},
                4);
    return builder;
}

// A strip of two squares, its left end held by joint 0 and its right end by joint 1, which turns by
// a quarter about Z from time 0 to 2.
//
//   1 --- 3 --- 5          5 --- 4
//   |     |     |    ->    1 \   |      vertex 3 lies halfway between where either joint
//   |     |     |          |   3 |      alone would take it
//   0 --- 2 --- 4          0 --- 2
//
// Nodes: 0 the strip, 1 and 2 the joints, 3 their parent, 10 metres up.
inline GltfBuilder make_strip(int joint_type = 5121, int weight_type = 5126) {
    GltfBuilder builder;
    const int positions =
        builder.add_positions({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0});
    std::vector<float> up;
    for (int i = 0; i < 6; ++i) up.insert(up.end(), {0, 0, 1});
    const int normals = builder.add_positions(up);
    const int indices = builder.add_accessor(
        std::vector<uint16_t>{0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3}, 5123, "SCALAR", 1);
    const std::vector<int> left = {2, 2, 1, 1, 0, 0}; // halves of the weight
    std::vector<uint8_t> joints;
    std::vector<float> weights;
    for (const int halves : left) {
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), {0.5f * static_cast<float>(halves),
                                       0.5f * static_cast<float>(2 - halves), 0.0f, 0.0f});
    }
    const auto add = [&](const std::vector<float>& values, int type, float scale) {
        if (type == 5126) return builder.add_accessor(values, type, "VEC4", 4);
        std::vector<uint8_t> bytes;
        std::vector<uint16_t> shorts;
        for (const float value : values) {
            bytes.push_back(static_cast<uint8_t>(value * scale));
            shorts.push_back(static_cast<uint16_t>(value * scale));
        }
        return type == 5121 ? builder.add_accessor(bytes, type, "VEC4", 4)
                            : builder.add_accessor(shorts, type, "VEC4", 4);
    };
    const int joint_accessor =
        add(std::vector<float>(joints.begin(), joints.end()), joint_type, 1.0f);
    const int weight_accessor = add(weights, weight_type, 254.0f); // halves of it are whole
    if (weight_type != 5126)
        builder.json["accessors"][static_cast<size_t>(weight_accessor)]["normalized"] = true;
    builder.show({{"attributes",
                   {{"POSITION", positions},
                    {"NORMAL", normals},
                    {"JOINTS_0", joint_accessor},
                    {"WEIGHTS_0", weight_accessor}}},
                  {"indices", indices}},
                 {{"skin", 0}});
    builder.push("nodes", {{"children", {2}}});
    builder.push("nodes", {{"translation", {1, 0, 0}}});
    builder.push("nodes", {{"children", {1}}, {"translation", {0, 10, 0}}});
    const int binds =
        builder.add_accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1, //
                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                             5126, "MAT4", 16);
    builder.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}}};
    builder.json["scenes"][0]["nodes"] = {0, 3};
    add_channel(builder, 2, "rotation", "LINEAR", {0, 2}, {0, 0, 0, 1, 0, 0, half_root, half_root},
                4);
    return builder;
}

} // namespace host::test
