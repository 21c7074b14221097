#pragma once

#include <peregrine/rt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace peregrine::test {

inline void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "api_fuzz: %s; last error: %s\n", what, rt_get_last_error());
    std::abort();
}

// SplitMix64 (Steele, Lea and Flood 2014): the same numbers on every machine.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t bits() {
        uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    uint32_t below(uint32_t n) { return uint32_t(bits() % n); }
    bool one_in(uint32_t n) { return below(n) == 0; }
    float unit() { return float(bits() >> 40) / float(1 << 24); }

    // Mostly tame, sometimes anything.
    float number() {
        static constexpr float kOdd[] = {0.0f,
                                         -0.0f,
                                         1.0f,
                                         -1.0f,
                                         1e-45f,
                                         1e-30f,
                                         1e30f,
                                         -1e30f,
                                         1.1e30f,
                                         3.4e38f,
                                         -3.4e38f,
                                         std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity(),
                                         std::numeric_limits<float>::quiet_NaN()};
        return one_in(40) ? kOdd[below(uint32_t(std::size(kOdd)))] : 8 * unit() - 4;
    }
    template <class T>
    T pick(const std::vector<T>& values) {
        return values.empty() || one_in(30) ? T{below(8), below(8)}
                                            : values[below(uint32_t(values.size()))];
    }

private:
    uint64_t state_;
};

class Fuzzer {
public:
    explicit Fuzzer(uint64_t seed) : random_(seed) {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.worker_count = random_.below(4);
        check(rt_create_scene(&desc, &scene_));
        require(last_ == RT_OK, "no scene");
    }
    ~Fuzzer() { check(rt_destroy_scene(scene_)); }
    Fuzzer(const Fuzzer&) = delete;
    Fuzzer& operator=(const Fuzzer&) = delete;

    void step() {
        switch (random_.below(24)) {
        case 0:
            return add_texture();
        case 1:
            return remove(textures_, rt_remove_texture);
        case 2:
            return add_material();
        case 3:
            return update_material();
        case 4:
            return remove(materials_, rt_remove_material);
        case 5:
        case 6:
            return add_mesh();
        case 7:
        case 8:
            return update_mesh();
        case 9:
            return remove(meshes_, rt_remove_mesh);
        case 10:
            return add_light();
        case 11:
            return remove(lights_, rt_remove_light);
        case 12:
            adapt_exposure();
            return set_environment();
        case 13:
            return commit();
        case 14:
            return render();
        case 15:
            return move_mesh();
        case 16:
            return add_instance();
        case 17:
            return add_program();
        case 18:
            return remove(programs_, rt_remove_program);
        case 19:
            return bake();
        default:
            return query();
        }
    }

private:
    rt_result check(rt_result result) {
        last_ = result;
        require(result >= RT_OK && result < RT_ERROR_INTERNAL, "a result that must not be");
        require(result == RT_OK || rt_get_last_error()[0] != '\0', "an error without a sentence");
        return result;
    }

    // Now and then a byte of a struct becomes another, or its size an odd one; pointers, counts and
    // strides stay apart.
    template <class Struct>
    void spoil(Struct& desc, size_t first, size_t end = sizeof(Struct)) {
        if (random_.one_in(60)) desc.struct_size = uint32_t(random_.bits()) | 1;
        if (!random_.one_in(6)) return;
        auto* bytes = reinterpret_cast<unsigned char*>(&desc);
        bytes[first + random_.bits() % (end - first)] = uint8_t(random_.bits());
    }

    std::vector<float> numbers(size_t count) {
        std::vector<float> values(count);
        for (float& value : values) value = random_.number();
        return values;
    }

    template <class Handle, class Remove>
    void remove(std::vector<Handle>& handles, Remove call) {
        if (handles.size() < 6 && !random_.one_in(4)) return;
        const Handle handle = random_.pick(handles);
        if (check(call(scene_, handle)) != RT_OK) return;
        std::erase_if(handles, [&](Handle h) {
            return h.index == handle.index && h.generation == handle.generation;
        });
    }

    void add_texture();
    rt_material_desc material();
    static void shade(void* user, const rt_program_batch* b);
    void add_program();
    void add_material();
    void update_material();
    void add_mesh();
    void move_mesh();
    void add_instance();
    void update_mesh();
    void add_light();
    void set_environment();
    void adapt_exposure();
    void commit();
    void bake();
    void render();
    void query();
    void query_arrays(rt_query_desc desc, rt_result expected, const std::vector<rt_hit>& hits);
    void resolve(std::vector<rt_hit>& hits);
    struct Moving {
        rt_mesh handle;
        uint32_t vertices;
    };

    Random random_;
    rt_result last_ = RT_OK;
    rt_scene scene_{};
    std::vector<rt_texture> textures_;
    std::vector<rt_material> materials_;
    std::vector<rt_program> programs_;
    std::vector<std::unique_ptr<uint32_t>> fields_; // of all programs: they outlive snapshots
    std::vector<rt_mesh> meshes_;
    std::vector<Moving> moving_;
    std::vector<rt_light> lights_;
};

} // namespace peregrine::test
