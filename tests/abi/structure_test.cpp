#include "support.h"

namespace peregrine::test {
namespace {

// Which structure, how well built: the same answers.
TEST(Structure, OfAnyKindAndQualityAnswersTheSame) {
    const WorldGuard world;
    const rt_scene scene = (*world).scene;
    const Bytes expected = answers(scene);
    for (const rt_structure structure :
         {RT_STRUCTURE_AUTO, RT_STRUCTURE_BVH, RT_STRUCTURE_KDTREE, RT_STRUCTURE_BIH})
        for (const rt_build_quality quality : {RT_BUILD_BALANCED, RT_BUILD_FAST, RT_BUILD_BEST}) {
            rt_commit_desc desc = rt_default_commit_desc();
            desc.structure = structure;
            desc.quality = quality;
            rt_commit_report report = rt_default_commit_report();
            ASSERT_OK(rt_commit_scene(scene, &desc, &report));
            EXPECT_EQ(report.structure,
                      structure == RT_STRUCTURE_AUTO ? RT_STRUCTURE_BVH : structure);
            EXPECT_EQ(report.quality, quality);
            EXPECT_EQ(answers(scene), expected);
            ASSERT_OK(rt_commit_scene(scene, &desc, &report));
            EXPECT_EQ(report.rebuilt, 0u);
        }
}

TEST(Structure, CompactOnesAnswerTheSameFromLessMemory) {
    const WorldGuard world;
    const rt_scene scene = (*world).scene;
    const Bytes expected = answers(scene);
    for (const rt_build_quality quality : {RT_BUILD_BALANCED, RT_BUILD_FAST, RT_BUILD_BEST}) {
        uint64_t bytes[2] = {};
        for (const rt_memory memory : {RT_MEMORY_FULL, RT_MEMORY_COMPACT}) {
            rt_commit_desc desc = rt_default_commit_desc();
            desc.quality = quality;
            desc.memory = memory;
            rt_commit_report report = rt_default_commit_report();
            ASSERT_OK(rt_commit_scene(scene, &desc, &report));
            EXPECT_EQ(answers(scene), expected);
            EXPECT_GT(report.tree_nodes, 0u);
            EXPECT_GT(report.bytes_nodes, 0u);
            bytes[memory] = report.bytes_nodes + report.bytes_triangles;
        }
        EXPECT_LT(bytes[RT_MEMORY_COMPACT], bytes[RT_MEMORY_FULL]);
    }
}

} // namespace
} // namespace peregrine::test
