#include "scene/commit.h"

#include "scene/light_proofs.h"

#include <algorithm>
#include <chrono>

namespace peregrine::scene {

namespace visibility = trace::visibility;

visibility::Lamp lamp_of(const Light& light) {
    visibility::Lamp lamp{};
    lamp.position = math::Vec3(light.position);
    lamp.direction = light.direction;
    lamp.reach = light.radius;
    lamp.is_far = light.type == LightType::directional;
    if (lamp.is_far) lamp.position = math::Vec3(0); // of no importance
    return lamp;
}

// The fixed triangles in the order of their numbers.
Commit::AllCorners Commit::fixed_corners() const {
    AllCorners all(&scene_.memory);
    all.reserve(snapshot_.fixed->infos.size());
    for (const geometry::TriangleInfo& info : snapshot_.fixed->infos) {
        const MeshData& mesh = *snapshot_.meshes[info.mesh].data;
        visibility::Corners corners{};
        for (uint32_t k = 0; k < 3; ++k)
            corners.v[k] = mesh.positions[mesh.triangles()[info.primitive][k]];
        corners.masked = (info.flags & geometry::kMasked) != 0;
        corners.single_sided = (info.flags & geometry::kSingleSided) != 0;
        all.push_back(corners);
    }
    return all;
}

// Keeps what still holds of the last commit's proofs, and lists the lights that are to be proved:
// those that are new, and those that stood still since the last commit.
Commit::WantedProofs Commit::keep_proofs() {
    WantedProofs wanted(&scene_.recycled);
    const auto& slots = scene_.lights.slots();
    views_.resize(slots.size());
    const bool is_new_geometry = snapshot_.fixed != scene_.fixed_;
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!slots[i].object) continue;
        const Light& light = lights_[number_of_light_[i]];
        const visibility::Lamp lamp = lamp_of(light);
        const LightView none;
        const LightView& last = i < scene_.views_.size() ? scene_.views_[i] : none;
        LightView& view = views_[i];
        if (last.holds_for(lamp, slots[i].generation, snapshot_.fixed)) {
            view = last;
        } else {
            view.geometry = snapshot_.fixed;
            view.lamp = lamp;
            view.generation = slots[i].generation;
        }
        const bool moved = last.generation == slots[i].generation
                           && !last.holds_for(lamp, slots[i].generation, last.geometry);
        if (options_.proofs.proves && !view.view && light.casts_shadow && light.source_radius == 0
            && (is_new_geometry || !moved))
            wanted.push_back({i, slots[i].generation, lamp});
    }
    return wanted;
}

// Proofs that were begun belong to the scene, also if this commit fails.
void Commit::go_on_proving(const WantedProofs& wanted,
                           std::chrono::steady_clock::time_point begin) {
    const ProofChoice& choice = options_.proofs;
    std::optional<LightProofs>& proofs = scene_.proofs_;
    if (!proofs || !proofs->are_of(snapshot_.fixed, choice.patch_size)) {
        proofs.reset();
        proofs.emplace(snapshot_.fixed, fixed_corners(), choice.patch_size, &scene_.memory);
    }
    proofs->want(wanted, choice.most_bytes);
    const uint64_t before = proofs->proof_count();
    std::optional<LightProofs::Clock::time_point> deadline;
    if (choice.budget_ms > 0)
        deadline = begin
                   + std::chrono::duration_cast<LightProofs::Clock::duration>(
                       std::chrono::duration<float, std::milli>(std::min(choice.budget_ms, 1e9f)));
    base::PartProgress part(options_.progress, build_share(), 1 - build_share());
    proofs->run(deadline, scene_.scheduler, part.progress());
    proof_report_.proofs = proofs->proof_count() - before;
    proof_report_.waiting = proofs->waiting();
}

void Commit::prove_lights() {
    if (scene_.views_.empty() && !options_.proofs.proves) return;
    const auto begin = std::chrono::steady_clock::now();
    number_of_light_.assign(scene_.lights.slots().size(), 0);
    for (uint32_t i = 0, number = 0; i < number_of_light_.size(); ++i)
        if (scene_.lights.slots()[i].object) number_of_light_[i] = number++;
    const WantedProofs wanted = keep_proofs();
    if (!wanted.empty() && !snapshot_.fixed->infos.empty()) {
        go_on_proving(wanted, begin);
        for (const LightProofs::Wanted& light : wanted)
            views_[light.slot].view = scene_.proofs_->result(light.slot);
    }
    for (LightView& view : views_) {
        if (!view.view) continue;
        if (proof_report_.bytes + view.view->bytes() > options_.proofs.most_bytes) {
            view.view.reset();
            continue;
        }
        proof_report_.bytes += view.view->bytes();
        ++proof_report_.lights;
    }
    if (proof_report_.lights > 0) {
        light_views_.resize(lights_.size());
        for (uint32_t i = 0; i < views_.size(); ++i)
            if (views_[i].view) light_views_[number_of_light_[i]] = views_[i].view;
    }
    proof_report_.ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace peregrine::scene
