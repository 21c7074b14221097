#include "shade/program/programs.h"

#include "shade/program/program_answers.h"
#include "shade/program/program_batch.h"
#include "shade/scratch.h"

#include <algorithm>

namespace peregrine::shade {

using scene::HostProgram;

namespace {

void add_span(const TriangleRun& run, ProgramMemory& memory) {
    if (memory.span_count > 0 && memory.spans[memory.span_count - 1].end == run.begin)
        memory.spans[memory.span_count - 1].end = run.end;
    else
        memory.spans[memory.span_count++] = {run.begin, run.end};
}

} // namespace

Programs::Programs(const scene::Snapshot& snapshot, uint32_t features, const SurfaceSpace& space)
    : snapshot_(&snapshot), space_(space), features_(features),
      any_((features & scene::kPrograms) != 0) {
    if (!any_) return;
    for (const HostProgram& program : snapshot.material_set->programs)
        some_are_unlit_ = some_are_unlit_ || (program.call && !program.wants_light());
}

bool Programs::find_programs(const RayHits& hits, Scratch& scratch) const {
    const Surface& surface = scratch.surface;
    bool found = false;
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        uint32_t& program = scratch.programs->program[r];
        program = 0;
        const uint32_t triangle = hits.triangle[surface.runs[r].begin];
        if (triangle == geometry::kNoTriangle) continue;
        const geometry::TriangleInfo info = trace::info(snapshot_->world, triangle);
        program = snapshot_->material_of(snapshot_->meshes[info.mesh], info.primitive).program;
        found = found || program != 0;
    }
    return found;
}

void Programs::turn_away(const RayHits& hits, Scratch& scratch) const {
    ProgramMemory& memory = *scratch.programs;
    Surface& surface = scratch.surface;
    memory.span_count = 0;
    if (!find_programs(hits, scratch)) return;
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        const uint32_t number = memory.program[r];
        if (number != 0 && !snapshot_->material_set->programs[number].wants_light())
            add_span(surface.runs[r], memory);
    }
    for (uint32_t s = 0; s < memory.span_count; ++s) {
        const auto [begin, end] = memory.spans[s];
        for (int k = 0; k < 3; ++k) {
            float* const geometric = surface.geometric[k] + begin;
            float* const normal = surface.normal[k] + begin;
            std::copy_n(geometric, end - begin, memory.unlit_geometric[k] + begin);
            std::copy_n(normal, end - begin, memory.unlit_normal[k] + begin);
            std::fill_n(geometric, end - begin, 0.0f);
            std::fill_n(normal, end - begin, 0.0f);
        }
    }
}

void Programs::turn_back(Scratch& scratch) const {
    const ProgramMemory& memory = *scratch.programs;
    Surface& surface = scratch.surface;
    for (uint32_t s = 0; s < memory.span_count; ++s) {
        const auto [begin, end] = memory.spans[s];
        for (int k = 0; k < 3; ++k) {
            std::copy(memory.unlit_geometric[k] + begin, memory.unlit_geometric[k] + end,
                      surface.geometric[k] + begin);
            std::copy(memory.unlit_normal[k] + begin, memory.unlit_normal[k] + end,
                      surface.normal[k] + begin);
        }
    }
}

// The runs of one program, which are done then.
void Programs::collect(uint32_t program, const Surface& surface, ProgramMemory& memory) const {
    memory.span_count = memory.run_count = memory.count = 0;
    for (uint32_t r = 0; r < surface.run_count; ++r) {
        if (memory.program[r] != program) continue;
        memory.program[r] = 0;
        memory.runs[memory.run_count++] = r;
        memory.count += surface.runs[r].end - surface.runs[r].begin;
        add_span(surface.runs[r], memory);
    }
}

void Programs::run(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                   Surroundings from, const AskedRays* rays) const {
    if (!find_programs(hits, scratch)) return;
    ProgramMemory& memory = *scratch.programs;
    BatchPacker packer(*snapshot_, features_, space_, hits, scratch, from);
    for (uint32_t r = 0; r < scratch.surface.run_count; ++r) {
        const uint32_t number = memory.program[r];
        if (number == 0) continue;
        const HostProgram& program = snapshot_->material_set->programs[number];
        collect(number, scratch.surface, memory);
        program.call(program, packer.pack(program));
        ProgramAnswers(*snapshot_, space_, hits, scratch, rays).take(program, radiance);
    }
}

} // namespace peregrine::shade
