#include <cstdlib>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "options.h"

namespace host::test {
namespace {

ParsedOptions parse(std::initializer_list<const char*> arguments) {
    std::vector<const char*> argv = {"peregrine_play"};
    argv.insert(argv.end(), arguments);
    return parse_options(static_cast<int>(argv.size()), argv.data());
}

class OptionsTest : public testing::Test {
protected:
    void SetUp() override { unsetenv("PEREGRINE_ISA"); }
};

TEST_F(OptionsTest, Defaults) {
    const auto parsed = parse({});
    ASSERT_TRUE(parsed.options);
    EXPECT_EQ(parsed.options->width, 1280u);
    EXPECT_EQ(parsed.options->height, 720u);
    EXPECT_GE(parsed.options->threads, 1u);
    EXPECT_FALSE(parsed.options->frames);
    EXPECT_EQ(parsed.options->isa, RT_ISA_BEST);
    EXPECT_EQ(parsed.options->structure, RT_STRUCTURE_AUTO);
    EXPECT_EQ(parsed.options->build, RT_BUILD_BALANCED);
}

TEST_F(OptionsTest, ReadsValues) {
    const auto parsed =
        parse({"--size",     "64x32",       "--frames", "3",           "--view", "depth",
               "--headless", "--out",       "a.png",    "--isa",       "avx2",   "--exposure",
               "2.5",        "--structure", "kdtree",   "--build",     "best",   "--animation",
               "walk",       "--time",      "1.5",      "--time-step", "0"});
    ASSERT_TRUE(parsed.options) << parsed.text;
    EXPECT_EQ(parsed.options->width, 64u);
    EXPECT_EQ(parsed.options->height, 32u);
    EXPECT_EQ(parsed.options->frames, 3u);
    EXPECT_EQ(parsed.options->view, RT_VIEW_DEPTH);
    EXPECT_EQ(parsed.options->isa, RT_ISA_AVX2);
    EXPECT_EQ(parsed.options->structure, RT_STRUCTURE_KDTREE);
    EXPECT_EQ(parsed.options->build, RT_BUILD_BEST);
    EXPECT_EQ(parsed.options->exposure, 2.5f);
    EXPECT_EQ(parsed.options->animation, "walk");
    EXPECT_EQ(parsed.options->time, 1.5);
    EXPECT_EQ(parsed.options->time_step, 0.0);
    EXPECT_EQ(parse({"--light-block", "8"}).options->light_block, 8u);
    EXPECT_EQ(parse({"--emissive-lamps", "40"}).options->emissive_lamps, 40u);
    const auto occlusion = parse({"--occlusion", "1.5", "--occlusion-block", "1"});
    EXPECT_EQ(occlusion.options->occlusion_range, 1.5f);
    EXPECT_EQ(occlusion.options->occlusion_block, 1u);
    EXPECT_EQ(parse({"--bloom", "0.5"}).options->bloom, 0.5f);
    EXPECT_EQ(parse({"--fog-lamps", "0.5"}).options->fog_lamps, 0.5f);
    const auto fog = parse({"--fog", "0.25,3"}).options->fog;
    EXPECT_TRUE(fog && fog->density == 0.25f && fog->top == 3.0f);
    EXPECT_EQ(parse({"--edges", "4"}).options->edge_samples, 4u);
    EXPECT_EQ(parse({"--embers", "70"}).options->embers, 70u);
    EXPECT_EQ(parse({"--effects", "rich"}).options->effects, Effects::rich);
}

TEST_F(OptionsTest, MistakesGetASentenceAndStatusTwo) {
    for (const auto& arguments : std::initializer_list<std::initializer_list<const char*>>{
             {"--size", "64"},
             {"--light-block", "7"},
             {"--occlusion", "-1"},
             {"--emissive-lamps", "-1"},
             {"--occlusion-block", "2"},
             {"--bloom", "2"},
             {"--fog-lamps", "1.5"},
             {"--fog-shadows", "33"},
             {"--fog", "0.1"},
             {"--fog", "0.1,-2"},
             {"--fog", "nan,2"},
             {"--embers", "-1"},
             {"--effects", "most"},
             {"--edges", "17"},
             {"--size", "0x64"},
             {"--size", "-1x64"},
             {"--size", "64x99999"},
             {"--size", "64x64x"},
             {"--frames", "0"},
             {"--frames", "many"},
             {"--view", "x-ray"},
             {"--isa", "mmx"},
             {"--structure", "octree"},
             {"--build", "slow"},
             {"--threads", "0"},
             {"--threads", "1000"},
             {"--exposure", "0"},
             {"--exposure", "nan"},
             {"--ambient", "-1"},
             {"--scale", "2"},
             {"--time", "-1"},
             {"--time", "nan"},
             {"--time-step", "-1"},
             {"--out", "a.png"},
             {"--headless", "--out", "a.gif"},
             {"--headless", "--out", "a_%d.txt"},
             {"--difficulty", "absurd"},
             {"--seed", "-1"},
             {"--seed", "72057594037927936"},
             {"--bot", "--replay", "a"},
             {"--replay", "a", "--seed", "1"},
             {"--view-only", "--bot"},
             {"--view-only", "--record", "a"},
             {"--headless", "--record", "a"},
             {"--headless", "--bot", "--out", "a.png"},
             {"--scene"},
             {"--what"},
             {"stray"}}) {
        const auto parsed = parse(arguments);
        EXPECT_FALSE(parsed.options) << *arguments.begin();
        EXPECT_EQ(parsed.exit_status, 2);
        EXPECT_FALSE(parsed.text.empty());
    }
}

TEST_F(OptionsTest, HelpAndVersionAreNoMistakes) {
    EXPECT_EQ(parse({"--help"}).exit_status, 0);
    EXPECT_NE(parse({"--help"}).text.find("--scene"), std::string::npos);
    EXPECT_EQ(parse({"--version"}).exit_status, 0);
}

TEST_F(OptionsTest, OfTheGame) {
    const auto none = parse({});
    EXPECT_TRUE(none.options->game());
    EXPECT_FALSE(none.options->difficulty || none.options->seed || none.options->scale);
    const auto parsed = parse({"--difficulty", "hard", "--seed", "12", "--record", "a.replay",
                               "--bot", "--mute", "--headless"});
    ASSERT_TRUE(parsed.options) << parsed.text;
    EXPECT_EQ(parsed.options->difficulty, peregrine::three_cores::Difficulty::hard);
    EXPECT_EQ(parsed.options->seed, 12u);
    EXPECT_EQ(parsed.options->record, "a.replay");
    EXPECT_TRUE(parsed.options->bot && parsed.options->mute && parsed.options->game());
    EXPECT_TRUE(parse({"--headless", "--replay", "a.replay"}).options->game());
}

TEST_F(OptionsTest, PicturesAndLookingAroundAreNoGame) {
    EXPECT_FALSE(parse({"--view-only"}).options->game());
    EXPECT_FALSE(parse({"--headless"}).options->game());
    EXPECT_FALSE(parse({"--headless", "--out", "a.png"}).options->game());
    EXPECT_FALSE(parse({"--list-cameras"}).options->game());
}

TEST_F(OptionsTest, ListsPads) {
    EXPECT_FALSE(parse({}).options->list_pads);
    const auto parsed = parse({"--list-pads", "--pad-map", "my.pads"});
    ASSERT_TRUE(parsed.options) << parsed.text;
    EXPECT_TRUE(parsed.options->list_pads);
    EXPECT_EQ(parsed.options->pad_map, "my.pads");
}

TEST_F(OptionsTest, TheOptionWinsOverTheEnvironment) {
    setenv("PEREGRINE_ISA", "sse4", 1);
    EXPECT_EQ(parse({}).options->isa, RT_ISA_SSE4);
    EXPECT_EQ(parse({"--isa", "scalar"}).options->isa, RT_ISA_SCALAR);
    setenv("PEREGRINE_ISA", "mmx", 1);
    EXPECT_EQ(parse({}).exit_status, 2);
    unsetenv("PEREGRINE_ISA");
}

} // namespace
} // namespace host::test
