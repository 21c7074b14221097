// A batch of rays in both of the forms that the door takes, and its answers in both forms.
#pragma once

#include "support.h"

#include <memory>

namespace peregrine::test {

// Elements from `offset` bytes beyond a multiple of 64 on, with not a byte more than they need.
template <class T>
class PlacedArray {
public:
    PlacedArray(size_t count, size_t offset, unsigned char fill = 0)
        : bytes_(64 + offset + count * sizeof(T), fill) {
        void* place = bytes_.data();
        size_t space = bytes_.size();
        first_ = static_cast<unsigned char*>(std::align(64, 1, place, space)) + offset;
    }

    T* data() { return reinterpret_cast<T*>(first_); }
    T at(size_t i) const {
        T value;
        std::memcpy(&value, first_ + i * sizeof value, sizeof value);
        return value;
    }
    void set(size_t i, const T& value) {
        std::memcpy(first_ + i * sizeof value, &value, sizeof value);
    }

private:
    Bytes bytes_;
    unsigned char* first_;
};

struct RayBatch {
    RayBatch(const std::vector<rt_ray>& rays, size_t offset) : count(rays.size()) {
        for (auto& lane : lanes) lane = std::make_unique<PlacedArray<float>>(count, offset);
        for (size_t i = 0; i < count; ++i) {
            for (size_t k = 0; k < 3; ++k) {
                lanes[k]->set(i, rays[i].origin[k]);
                lanes[3 + k]->set(i, rays[i].direction[k]);
            }
            lanes[6]->set(i, rays[i].t_min);
            lanes[7]->set(i, rays[i].t_max);
        }
        for (size_t k = 0; k < 3; ++k) {
            arrays.origin[k] = lanes[k]->data();
            arrays.direction[k] = lanes[3 + k]->data();
        }
        arrays.t_min = lanes[6]->data();
        arrays.t_max = lanes[7]->data();
    }

    size_t count;
    std::unique_ptr<PlacedArray<float>> lanes[8];
    rt_ray_arrays arrays = rt_default_ray_arrays();
};

struct HitBatch {
    HitBatch(size_t n, size_t offset)
        : count(n), t(n, offset, 0xa5), u(n, offset, 0xa5), v(n, offset, 0xa5),
          triangle(n, offset, 0xa5), mesh(n, offset, 0xa5), back_face(n, offset, 0xa5) {
        arrays.t = t.data();
        arrays.u = u.data();
        arrays.v = v.data();
        arrays.triangle = triangle.data();
        arrays.mesh = mesh.data();
        arrays.back_face = back_face.data();
    }

    rt_hit hit(size_t i) const {
        return {t.at(i), u.at(i), v.at(i), triangle.at(i), mesh.at(i), 0, back_face.at(i)};
    }
    std::vector<rt_hit> hits() const {
        std::vector<rt_hit> all(count);
        for (size_t i = 0; i < count; ++i) all[i] = hit(i);
        return all;
    }

    size_t count;
    PlacedArray<float> t, u, v;
    PlacedArray<uint32_t> triangle;
    PlacedArray<rt_mesh> mesh;
    PlacedArray<uint32_t> back_face;
    rt_hit_arrays arrays = rt_default_hit_arrays();
};

inline Bytes bytes_of(const std::vector<rt_hit>& hits) {
    Bytes bytes(hits.size() * sizeof(rt_hit));
    if (!hits.empty()) std::memcpy(bytes.data(), hits.data(), bytes.size());
    return bytes;
}

} // namespace peregrine::test
