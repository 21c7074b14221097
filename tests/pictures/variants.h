#pragma once

#include "golden.h"

#include "stage.h"

#include <peregrine/rt.h>

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace peregrine::test {

// What pictures are made with: each instruction set and number of threads gives the same bits.
struct Variant {
    const char* name;
    rt_isa isa;
    uint32_t threads;
    bool proofs = false; // made by each commit
};

void PrintTo(const Variant& variant, std::ostream* out);

// All of them, also those that this machine lacks.
testing::internal::ParamGenerator<Variant> all_variants();

// Without any approximation.
rt_frame_desc frame_of(uint32_t width, uint32_t height,
                       rt_pixel_format format = RT_FORMAT_RGBA8_SRGB);

Picture blank(const rt_frame_desc& frame, uint32_t units);
void render(const host::Stage& stage, const rt_camera& camera, const rt_frame_desc& frame);
void expect_pixels(const std::string& name, const std::string& how, const host::Stage& stage,
                   const rt_camera& camera, rt_frame_desc frame);

class Pictures : public testing::TestWithParam<Variant> {
protected:
    void SetUp() override;

    std::string how() const { return GetParam().name; }
    void commit() {
        rt_commit_desc desc = rt_default_commit_desc();
        if (GetParam().proofs) desc.light_proofs = RT_LIGHT_PROOFS_MADE;
        stage_->check(stage_->api().commit_scene(stage_->scene(), &desc, nullptr), "building");
    }

    void expect(const std::string& name, const rt_camera& camera, const rt_frame_desc& frame) {
        expect_pixels(name, how(), *stage_, camera, frame);
    }

    std::unique_ptr<host::Stage> stage_;
};

} // namespace peregrine::test
