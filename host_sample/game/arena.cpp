#include "arena.h"

#include <cctype>
#include <filesystem>

#include "gameplay/world.h"

#include "../cameras.h"
#include "../error.h"
#include "../gltf/import.h"
#include "../loading.h"
#include "node_names.h"
#include "plan_from_level.h"

namespace host::game {

namespace {

constexpr float night_ambient = 0.05f;

Level import_level(const Options& options, const Arena::Progress& progress) {
    progress("Reading the level", 0.0f);
    Level level = load_level(options, gltf::no_animation, is_moved);
    light_mist(level);
    return level;
}

three_cores::Plan make_plan(const Level& level, const Uploaded& uploaded, const Stage& stage) {
    three_cores::Plan plan = plan_from_level(level, uploaded);
    try {
        complete_plan(plan, gameplay::World(stage.api(), stage.scene()));
    } catch (const three_cores::PlanError& error) {
        throw InputError("the scene file " + level.name + " cannot be played: " + error.what());
    }
    return plan;
}

} // namespace

Arena::Arena(const Options& options, const Progress& progress)
    : options_(options), level_(import_level(options, progress)), plugin_(options.library),
      stage_(plugin_.api(), options.threads, options.isa),
      player_(stage_, level_,
              upload_level(stage_, level_, options.ambient.value_or(night_ambient),
                           ripples_.add_to(stage_))),
      effects_(stage_, level_, player_.uploaded().lights, !options.fog),
      commit_(rt_default_commit_desc()) {
    commit_.structure = options.structure;
    commit_.quality = options.build;
    player_.describe(0.0);
    report_ = stage_.commit(options.structure, options.build,
                            [&](float fraction) { progress("Building the level", fraction); });
    progress("Looking at the level", 1.0f);
    plan_ = make_plan(level_, player_.uploaded(), stage_);
}

std::string Arena::level_name() const {
    std::string name = std::filesystem::path(level_.name).stem().string();
    if (!name.empty())
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

Session Arena::session() {
    auto cameras = usable_cameras(level_);
    const size_t camera = find_camera(cameras, options_.camera);
    return {options_, level_, std::move(cameras), camera, stage_, player_, report_, {}, 0, 0};
}

} // namespace host::game
