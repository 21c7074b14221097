#include "light_baker.h"

#include <pthread.h>

#include "../effects/choose.h"

namespace host::game {

LightBaker::LightBaker(const Stage& stage)
    : thread_([this, &api = stage.api(), scene = stage.scene()] {
          pthread_setname_np(pthread_self(), "light_baker"); // who looks may see it end
          rt_bake_desc desc = rt_default_bake_desc();
          desc.samples = 32; // half the time, and nothing to be seen of it
          desc.occlusion_range = occlusion_range;
          desc.progress = [](void* user, float) -> int32_t {
              return *static_cast<const std::atomic<bool>*>(user);
          };
          desc.progress_user = &stops_;
          api.bake_light(scene, &desc, nullptr);
      }) {}

LightBaker::~LightBaker() {
    stops_ = true;
    thread_.join();
}

} // namespace host::game
