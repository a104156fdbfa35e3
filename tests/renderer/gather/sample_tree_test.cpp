// The tree of samples after edits: what is taken from the tree before is what would be made anew.
#include "renderer/gather/sample_tree.h"
#include "tests/renderer/gather/light_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace celadon {
namespace {

using namespace test;

void expectEqual(const SampleTree& a, const SampleTree& b) {
    ASSERT_EQ(a.levels().size(), b.levels().size());
    EXPECT_EQ(a.codes(), b.codes());
    for (std::size_t k = 0; k < a.levels().size(); ++k) {
        const SampleTree::Level& x = a.levels()[k];
        const SampleTree::Level& y = b.levels()[k];
        ASSERT_EQ(x.samples.size(), y.samples.size());
        EXPECT_EQ(0, std::memcmp(x.samples.data(), y.samples.data(),
                                 x.samples.size() * sizeof(gather::Sample)))
            << "level " << k;
        for (std::size_t i = 0; i < x.nodes.size(); ++i) {
            EXPECT_EQ(x.nodes[i].ball, y.nodes[i].ball);
            EXPECT_EQ(x.nodes[i].R_P, y.nodes[i].R_P);
            EXPECT_EQ(x.nodes[i].selected, y.nodes[i].selected);
        }
    }
}

TEST(ChangedTexels, TouchIsTrueWhereAProfileIsAnotherOne) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-0.5f, 1.5f);
    std::uniform_int_distribution<int> column(0, kMapWidth - 4);
    std::uniform_int_distribution<int> row(0, kMapHeight - 3);
    int touched = 0;
    int asked = 0;
    for (int i = 0; i < 40; ++i) {
        const Materials before = twoMaterials();
        const Materials after = twoMaterials();
        const subedit::TexelRect rect{column(random), row(random), 4, 3};
        edit(*after[1], rect, 1.1f);
        const ChangedTexels changed(gathered(after), std::vector<TexelChange>{{1, rect}});
        const std::size_t values = static_cast<std::size_t>(before[1]->knots()) * 3;
        std::vector<float> a(values);
        std::vector<float> b(values);
        for (int j = 0; j < 200; ++j) {
            const glm::vec2 uv(unit(random), unit(random));
            before[1]->sampleLogProfile(uv, a.data());
            after[1]->sampleLogProfile(uv, b.data());
            ++asked;
            touched += changed.touch(1, uv) ? 1 : 0;
            EXPECT_TRUE(a == b || changed.touch(1, uv)) << uv.x << " " << uv.y;
            EXPECT_FALSE(changed.touch(0, uv));
        }
    }
    EXPECT_GT(touched, asked / 50);
    EXPECT_LT(touched, asked / 10); // 6 x 5 of 24 x 20 texels
    EXPECT_FALSE(ChangedTexels().touch(0, {0.5f, 0.5f}));
}

TEST(SampleTree, WhatIsTakenFromTheTreeBeforeIsWhatWouldBeMadeAnew) {
    const LightSheet view;
    Materials materials = twoMaterials();
    const GatherMaterials gatherMaterials = gathered(materials);
    const TreeSettings settings;
    SampleTree tree;
    SampleTree before;
    tree.build(view.texels(), gatherMaterials, settings);
    for (const TexelChange& change : {TexelChange{0, {3, 4, 5, 2}}, TexelChange{1, {20, 16, 4, 4}},
                                      TexelChange{0, {0, 0, 1, 1}}}) {
        const std::vector<std::uint16_t> codes = tree.codes();
        edit(*materials[static_cast<std::size_t>(change.material)], change.rect, 1.1f);
        std::swap(tree, before);
        tree.takeWorkspace(before);
        tree.build(view.texels(), gatherMaterials, settings, &before,
                   ChangedTexels(gatherMaterials, std::vector<TexelChange>{change}));
        EXPECT_NE(tree.codes(), codes);
        SampleTree anew;
        anew.build(view.texels(), gatherMaterials, settings);
        expectEqual(tree, anew);
        expectEqual(tree.withoutWorkspace(), anew);
    }
}

} // namespace
} // namespace celadon
