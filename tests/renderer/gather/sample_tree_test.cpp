// The tree of samples after edits: what is taken from the tree before is what would be made anew.
#include "renderer/gather/sample_tree.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

namespace celadon {
namespace {

constexpr int kMapWidth = 24;
constexpr int kMapHeight = 20;

using Materials = std::vector<std::shared_ptr<subedit::MaterialMap>>;

Materials twoMaterials() {
    Materials materials;
    for (int i = 0; i < 2; ++i) {
        materials.push_back(std::make_shared<subedit::MaterialMap>(
            subedit::test::varyingMaterial(kMapWidth, kMapHeight, 16)));
    }
    return materials;
}

GatherMaterials gathered(const Materials& materials) {
    const std::vector<MaterialPointer> pointers(materials.begin(), materials.end());
    return GatherMaterials(pointers);
}

/// What a light view could see: a bent sheet, with holes, of two materials.
struct LightView {
    static constexpr int kSize = 40;
    std::vector<float> positions, normals, fluxes, surfaces, covariances, extents, kepts;

    LightView() {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const bool isLit = unit(random) > 0.1f;
                const float z = 0.01f * static_cast<float>((x - 20) * (x - 20));
                const auto put = [](std::vector<float>& to, float a, float b, float c, float d) {
                    to.insert(to.end(), {a, b, c, d});
                };
                put(positions, static_cast<float>(x), static_cast<float>(y), z,
                    isLit ? 50.0f : 0.0f);
                put(normals, 0.0f, 0.0f, 1.0f, 1.0f);
                put(fluxes, isLit ? 1.0f : 0.0f, isLit ? unit(random) : 0.0f, 0.0f, 0.0f);
                put(surfaces, 1.7f * unit(random) - 0.3f, 1.7f * unit(random) - 0.3f,
                    static_cast<float>(x % 2), 3.0f);
                put(covariances, 0.1f, 0.0f, 0.0f, 0.1f);
                put(extents, 0.0f, 0.01f, 3.0f, 20.0f);
                put(kepts, 1.0f, 1.0f, 1.0f, 2.0f);
            }
        }
    }
    [[nodiscard]] LightTexels texels() const {
        return {kSize,         kSize,           positions.data(),   normals.data(),
                fluxes.data(), surfaces.data(), covariances.data(), extents.data(),
                kepts.data()};
    }
};

void edit(subedit::MaterialMap& map, const subedit::TexelRect& rect) {
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            float* const values = map.logProfile.data() + map.index(x, y, 0);
            std::for_each(values, values + std::ptrdiff_t{3} * map.knots(),
                          [](float& value) { value -= 0.4f; });
        }
    }
}

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
        edit(*after[1], rect);
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
    const LightView view;
    Materials materials = twoMaterials();
    const GatherMaterials gatherMaterials = gathered(materials);
    const TreeSettings settings;
    SampleTree tree;
    SampleTree before;
    tree.build(view.texels(), gatherMaterials, settings);
    for (const TexelChange& change : {TexelChange{0, {3, 4, 5, 2}}, TexelChange{1, {20, 16, 4, 4}},
                                      TexelChange{0, {0, 0, 1, 1}}}) {
        const std::vector<std::uint16_t> codes = tree.codes();
        edit(*materials[static_cast<std::size_t>(change.material)], change.rect);
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
