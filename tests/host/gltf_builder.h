#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace host::test {

using Json = nlohmann::json;

// Writes small .glb files in memory.
class GltfBuilder {
public:
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};

    template <class T>
    int add_view(const std::vector<T>& values, int stride = 0) {
        while (bin_.size() % 4 != 0) bin_.push_back('\0');
        Json view = {
            {"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) view["byteStride"] = stride;
        bin_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return push("bufferViews", view);
    }

    template <class T>
    int add_accessor(const std::vector<T>& values, int component_type, const std::string& type,
                     int components) {
        return push("accessors", {{"bufferView", add_view(values)},
                                  {"componentType", component_type},
                                  {"type", type},
                                  {"count", values.size() / static_cast<size_t>(components)}});
    }

    int add_positions(const std::vector<float>& values) {
        return add_accessor(values, 5126, "VEC3", 3);
    }

    int push(const char* array, const Json& item) {
        json[array].push_back(item);
        return static_cast<int>(json[array].size()) - 1;
    }

    // A scene of one node that shows one mesh of one primitive.
    void show(const Json& primitive, const Json& node = Json::object()) {
        Json placed = node;
        placed["mesh"] = push("meshes", {{"primitives", {primitive}}});
        const int index = push("nodes", placed);
        json["scenes"] = {{{"nodes", {index}}}};
    }

    std::string text() const { // ready for a .gltf with a data URI
        Json copy = json;
        return copy.dump();
    }

    const std::string& bin() const { return bin_; }

    std::string glb() const {
        Json copy = json;
        std::string bin = bin_;
        while (bin.size() % 4 != 0 || bin.empty()) bin.push_back('\0');
        if (!copy.contains("buffers")) copy["buffers"] = {{{"byteLength", bin.size()}}};
        std::string text = copy.dump();
        while (text.size() % 4 != 0) text.push_back(' ');
        return wrap(text, bin);
    }

    static std::string wrap(const std::string& text, const std::string& bin) {
        std::string glb = "glTF";
        append(glb, 2);
        append(glb, static_cast<uint32_t>(28 + text.size() + bin.size()));
        append(glb, static_cast<uint32_t>(text.size()));
        append(glb, 0x4e4f534a);
        glb += text;
        append(glb, static_cast<uint32_t>(bin.size()));
        append(glb, 0x004e4942);
        return glb + bin;
    }

private:
    static void append(std::string& to, uint32_t value) {
        to.append(reinterpret_cast<const char*>(&value), 4);
    }

    std::string bin_;
};

// Two triangles: (0,0) (1,0) (1,1) (0,1) in the plane z = 0, facing +Z.
//
//   3 --- 2
//   |   / |
//   | /   |
//   0 --- 1
inline GltfBuilder make_quad() {
    GltfBuilder builder;
    const int positions = builder.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int normals = builder.add_positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int texcoords =
        builder.add_accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, 5126, "VEC2", 2);
    const int indices =
        builder.add_accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    builder.show(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}}},
         {"indices", indices}});
    return builder;
}

} // namespace host::test
