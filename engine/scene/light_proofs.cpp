#include "scene/light_proofs.h"

#include "base/error.h"

#include <algorithm>
#include <atomic>

namespace peregrine::scene {

namespace visibility = trace::visibility;

namespace {

constexpr std::chrono::milliseconds kSlice{20}; // between two looks at the progress

bool is_same(const LightProofs::Wanted& a, const LightProofs::Wanted& b) {
    return a.slot == b.slot && a.generation == b.generation && a.lamp.is_far == b.lamp.is_far
           && a.lamp.position == b.lamp.position && a.lamp.direction == b.lamp.direction
           && a.lamp.reach == b.lamp.reach;
}

} // namespace

LightProofs::LightProofs(std::shared_ptr<const Geometry> geometry, AllCorners corners,
                         float patch_size, base::Memory* memory)
    : geometry_(std::move(geometry)), patch_size_(patch_size), memory_(memory),
      corners_(std::move(corners)), tree_(corners_, memory), jobs_(memory) {}

void LightProofs::want(std::span<const Wanted> wanted, uint64_t most_bytes) {
    visibility::ProofOptions options;
    options.patch_size = patch_size_;
    if (!wanted.empty())
        options.most_words =
            uint32_t(std::min<uint64_t>(most_bytes / (4 * wanted.size()), options.most_words));
    base::Vector<Job> jobs(memory_);
    jobs.reserve(wanted.size());
    auto begun = jobs_.begin();
    for (const Wanted& light : wanted) {
        while (begun != jobs_.end() && begun->wanted.slot < light.slot) ++begun;
        if (begun != jobs_.end() && is_same(begun->wanted, light)) {
            jobs.push_back(*begun);
            continue;
        }
        const visibility::Setting setting =
            visibility::make_setting(light.lamp, geometry_->bounds());
        jobs.push_back({light, visibility::LampProof(tree_, setting, options, memory_)});
    }
    jobs_.swap(jobs);
}

void LightProofs::run(const std::optional<Clock::time_point>& deadline, base::Scheduler& scheduler,
                      const base::Progress& progress) {
    const uint32_t threads = std::max(scheduler.concurrency(), 1u);
    for (bool is_first = true; waiting() > 0; is_first = false) {
        const Clock::time_point now = Clock::now();
        if (!is_first && deadline && now >= *deadline) return;
        if (progress.cancels(1 - float(waiting()) / float(jobs_.size())))
            base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");
        const Clock::time_point end = deadline ? std::min(*deadline, now + kSlice) : now + kSlice;
        std::atomic<uint32_t> next{0};
        scheduler.for_each(threads, [&](uint32_t) {
            for (uint32_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < jobs_.size();) {
                Job& job = jobs_[i];
                if (job.is_done) continue;
                do job.is_done = !job.proof.step();
                while (!job.is_done && Clock::now() < end);
                if (!job.is_done) return;
            }
        });
    }
}

std::shared_ptr<const visibility::PointVisibility> LightProofs::result(uint32_t slot) const {
    const auto job =
        std::lower_bound(jobs_.begin(), jobs_.end(), slot,
                         [](const Job& other, uint32_t of) { return other.wanted.slot < of; });
    if (job == jobs_.end() || job->wanted.slot != slot || !job->is_done) return nullptr;
    return job->proof.result();
}

uint32_t LightProofs::waiting() const {
    return uint32_t(
        std::count_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return !job.is_done; }));
}

uint64_t LightProofs::proof_count() const {
    uint64_t count = 0;
    for (const Job& job : jobs_) count += job.proof.report().proofs;
    return count;
}

} // namespace peregrine::scene
