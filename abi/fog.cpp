#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

scene::Fog to_fog(const rt_fog& fields) {
    require_least_zero(fields.density, "rt_fog.density");
    for (const auto& [height, name] :
         {std::pair{fields.top, "rt_fog.top"}, std::pair{fields.bottom, "rt_fog.bottom"}})
        if (!is_coordinate(height))
            base::fail(base::Code::invalid_argument, "%s is %g; it must be a height", name, height);
    if (fields.bottom > fields.top)
        base::fail(base::Code::invalid_argument, "rt_fog.bottom is %g, above its top, %g",
                   fields.bottom, fields.top);
    require_colour(fields.color, "rt_fog.color");
    require_zero(fields.reserved, "rt_fog.reserved");
    return {fields.density,
            fields.top,
            fields.bottom,
            {fields.color[0], fields.color[1], fields.color[2]}};
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_set_fog(rt_scene scene, const rt_fog* fog) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        host.scene.fog = to_fog(read_struct(fog));
    });
}
