#include "scene/commit.h"

#include "base/error.h"
#include "trace/visibility/prove.h"

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
Commit::LightNumbers Commit::keep_proofs() {
    LightNumbers wanted(&scene_.recycled);
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
            wanted.push_back(i);
    }
    return wanted;
}

void Commit::prove_lights() {
    if (scene_.views_.empty() && !options_.proofs.proves) return;
    const auto begin = std::chrono::steady_clock::now();
    number_of_light_.assign(scene_.lights.slots().size(), 0);
    for (uint32_t i = 0, number = 0; i < number_of_light_.size(); ++i)
        if (scene_.lights.slots()[i].object) number_of_light_[i] = number++;
    const LightNumbers wanted = keep_proofs();
    if (!wanted.empty() && !snapshot_.fixed->infos.empty()) {
        const AllCorners corners = fixed_corners();
        const visibility::TriangleTree tree(corners, &scene_.memory);
        visibility::ProofOptions proof;
        proof.patch_size = options_.proofs.patch_size;
        proof.most_words = uint32_t(
            std::min<uint64_t>(options_.proofs.most_bytes / (4 * wanted.size()), proof.most_words));
        const uint32_t at_a_time = std::max(scene_.scheduler.concurrency(), 1u);
        for (uint32_t first = 0; first < wanted.size(); first += at_a_time) {
            const float done = float(first) / float(wanted.size());
            if (options_.progress.cancels(build_share() + (1 - build_share()) * done))
                base::fail(base::Code::cancelled,
                           "the commit was cancelled by its progress callback");
            const auto count = std::min(at_a_time, uint32_t(wanted.size()) - first);
            base::Vector<visibility::ProofReport> reports(count, &scene_.recycled);
            scene_.scheduler.for_each(count, [&](uint32_t i) {
                LightView& view = views_[wanted[first + i]];
                const visibility::Setting setting =
                    visibility::make_setting(view.lamp, snapshot_.fixed->bounds());
                view.view = visibility::prove(tree, setting, proof, &scene_.memory, reports[i]);
            });
            for (const visibility::ProofReport& report : reports)
                proof_report_.proofs += report.proofs;
        }
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
