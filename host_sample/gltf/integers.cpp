#include "integers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "../error.h"
#include "quote.h"

namespace host::gltf {

namespace {

using nlohmann::json;

// Whatever object they stand in: no other property of glTF 2.0 has one of these names.
constexpr std::array<std::string_view, 4> sizes = {"byteLength", "byteOffset", "byteStride",
                                                   "count"};
constexpr std::array<std::string_view, 27> indices = {
    "buffer",   "bufferView",    "camera",
    "children", "componentType", "index",
    "indices",  "input",         "inverseBindMatrices",
    "joints",   "magFilter",     "material",
    "mesh",     "minFilter",     "mode",
    "node",     "nodes",         "output",
    "sampler",  "scene",         "skeleton",
    "skin",     "source",        "target",
    "texCoord", "wrapS",         "wrapT"};
// All that stands in these: what they name are accessors.
constexpr std::array<std::string_view, 2> attributes = {"attributes", "targets"};
constexpr std::array<std::string_view, 2> not_of_the_core = {"extensions", "extras"};

template <size_t n>
bool has(const std::array<std::string_view, n>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

enum class Kind { other, index, size };

Kind kind_of(std::string_view key) {
    if (has(sizes, key)) return Kind::size;
    return has(indices, key) ? Kind::index : Kind::other;
}

// Where a value stands, for the sentences.
struct Place {
    const Place* parent = nullptr;
    std::string_view key; // empty: an element
    size_t element = 0;

    std::string text() const {
        const std::string before = parent ? parent->text() : "";
        if (key.empty() && parent) return before + "[" + std::to_string(element) + "]";
        return before + (before.empty() ? "" : ".") + quote(key, 40);
    }
};

class Settler {
public:
    // `kind` is that of the numbers that stand in an array or among attributes.
    void walk(json& value, const Place& place, Kind kind, bool sparse) {
        if (value.is_number()) {
            settle(value, place, sparse && kind == Kind::size ? Kind::index : kind);
        } else if (value.is_array()) {
            for (size_t i = 0; i < value.size(); ++i) walk(value[i], {&place, {}, i}, kind, sparse);
        } else if (value.is_object()) {
            for (auto& [key, member] : value.items())
                if (!has(not_of_the_core, key))
                    walk(member, {&place, key}, kind_in(place, key), sparse || key == "sparse");
        }
    }

private:
    static Kind kind_in(const Place& place, std::string_view key) {
        for (const Place* p = &place; p; p = p->parent) {
            if (has(attributes, p->key)) return Kind::index;
            if (!p->key.empty()) break;
        }
        return has(attributes, key) ? Kind::index : kind_of(key);
    }

    static void settle(json& number, const Place& place, Kind kind) {
        if (kind == Kind::other) return;
        if (number.is_number_float()) {
            const double value = number.get<double>();
            if (value != std::trunc(value)) refuse(number, place, "must be an integer");
            if (std::abs(value) > 9007199254740992.0) refuse(number, place, "is out of range");
            if (value < 0.0)
                number = static_cast<int64_t>(value);
            else
                number = static_cast<uint64_t>(value);
        }
        if (kind == Kind::size) {
            if (number.get<int64_t>() < 0 && !number.is_number_unsigned())
                refuse(number, place, "must not be negative");
        } else if (number.is_number_unsigned() ? number.get<uint64_t>() > 0x7fffffffu
                                               : number.get<int64_t>() < -0x80000000ll) {
            refuse(number, place, "is out of range");
        }
    }

    [[noreturn]] static void refuse(const json& number, const Place& place, const char* why) {
        throw InputError(place.text() + " is " + number.dump() + ", which " + why);
    }
};

} // namespace

void settle_integers(nlohmann::json& root) {
    for (auto& [key, value] : root.items())
        if (!has(not_of_the_core, key)) Settler().walk(value, {nullptr, key}, kind_of(key), false);
}

} // namespace host::gltf
