#include "lamps.h"

namespace host::game {

void LampPool::show(std::span<const rt_light_desc> lamps) {
    const rt_api& api = stage_.api();
    for (; lights_.size() > lamps.size(); lights_.pop_back())
        stage_.check(api.remove_light(stage_.scene(), lights_.back()), "removing a light");
    for (size_t i = 0; i < lights_.size(); ++i)
        stage_.check(api.update_light(stage_.scene(), lights_[i], &lamps[i]), "moving a light");
    while (lights_.size() < lamps.size()) {
        rt_light light{};
        stage_.check(api.add_light(stage_.scene(), &lamps[lights_.size()], &light),
                     "adding a light");
        lights_.push_back(light);
    }
}

} // namespace host::game
