#include "render/bake/fixed_world.h"

namespace peregrine::render::bake {

FixedWorld::FixedWorld(const scene::Snapshot& whole, base::Memory* memory) : snapshot(memory) {
    using namespace scene;
    constexpr uint32_t kSeen = kTextures | kEmissive | kAlphaMask | kLights | kShadows
                               | kSingleSidedMaterials | kNormalMaps | kOcclusionTextures
                               | kLightPassingFeatures;
    snapshot.fixed = whole.fixed;
    snapshot.material_set = whole.material_set;
    snapshot.lights = whole.lights;
    snapshot.world = whole.world;
    snapshot.world.nodes = nullptr;
    snapshot.world.rests = nullptr;
    snapshot.world.instances = nullptr;
    snapshot.world.instance_count = 0;
    snapshot.world.bounds = whole.fixed->bounds();
    snapshot.meshes = whole.meshes;
    snapshot.environment.ambient = math::Vec3(0);
    snapshot.features = whole.features & kSeen;
    snapshot.origin = whole.origin;
    snapshot.displaced = whole.displaced;
}

} // namespace peregrine::render::bake
