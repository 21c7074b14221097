#pragma once

#include "gameplay/world.h"
#include "level.h"

#include <vector>

namespace peregrine::bench {

// Static triangles behind the header, for the rules of the game.
class Field {
public:
    explicit Field(const rt_api& api);
    ~Field();
    Field(const Field&) = delete;
    Field& operator=(const Field&) = delete;

    void add_quad(const gameplay::Vec3& a, const gameplay::Vec3& b, const gameplay::Vec3& c,
                  const gameplay::Vec3& d);
    void add_level(const host::Level& level);
    void commit();

    gameplay::World world() const { return {api_, scene_}; }

private:
    void require(rt_result result) const;

    const rt_api& api_;
    rt_scene scene_{};
    std::vector<glm::vec3> corners_;
};

} // namespace peregrine::bench
