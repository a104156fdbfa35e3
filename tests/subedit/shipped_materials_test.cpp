#include "subedit/errors.h"
#include "subedit/map/image_map.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/recipes/recipes.h"
#include "tests/subedit/support/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace celadon::subedit {
namespace {

TEST(ShippedMaterials, AreThereAndAreWhatTheirRecipesMake) {
    const std::vector<std::string> names = shippedMaterialNames();
    EXPECT_GE(names.size(), 8u);
    EXPECT_THAT(names, testing::Contains(kDefaultMaterial));
    for (const std::string& name : names) {
        std::vector<std::string> warnings;
        const MaterialMap shipped = readMaterial(findMaterial(name), &warnings);
        EXPECT_TRUE(warnings.empty()) << name;
        EXPECT_TRUE(std::filesystem::exists(shippedMaterialFolder() / (name + ".md"))) << name;
        const Recipe& recipe = findRecipe(name);
        EXPECT_EQ(shipped.width, recipe.size) << name;
#ifndef NDEBUG
        if (recipe.size > 1 && name != "yellow_wax") {
            continue; // seconds of unoptimized code each
        }
#endif
        const MaterialMap made = recipe.bake(recipe.size, {.segments = recipe.segments});
        EXPECT_EQ(shipped.maxRadiusMm, made.maxRadiusMm) << name;
        ASSERT_EQ(shipped.logProfile.size(), made.logProfile.size()) << name;
        for (std::size_t i = 0; i < made.logProfile.size(); ++i) {
            // One step of half precision, at most 1/64.
            ASSERT_NEAR(shipped.logProfile[i], made.logProfile[i], 1.01f / 64.0f) << name;
        }
    }
}

TEST(ShippedMaterials, PathsAreLeftAlone) {
    EXPECT_EQ(findMaterial("folder/thing"), "folder/thing");
    EXPECT_EQ(findMaterial("thing.subedit.exr"), "thing.subedit.exr");
}

TEST(ShippedMaterials, AnotherFolderCanBeNamed) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "mine.subedit.exr") << "";
    ::setenv("CELADON_MATERIALS", folder.path().c_str(), 1);
    EXPECT_EQ(shippedMaterialNames(), std::vector<std::string>{"mine"});
    EXPECT_EQ(findMaterial("mine"), folder / "mine.subedit.exr");
    ::setenv("CELADON_MATERIALS", "/absent", 1);
    EXPECT_THROW(static_cast<void>(shippedMaterialNames()), InputError);
    ::unsetenv("CELADON_MATERIALS");
}

TEST(ImageMap, ResizingKeepsTheMean) {
    ImageMap map{4, 4, {}};
    for (int i = 0; i < 16; ++i) {
        map.values.push_back(glm::vec3(static_cast<float>(i)));
    }
    const ImageMap small = resizeImageMap(map, 1, 1);
    EXPECT_NEAR(small.values[0].x, 7.5f, 1e-5f);
    EXPECT_NEAR(resizeImageMap(map, 2, 2).values[0].x, 2.5f, 1e-5f); // of 0, 1, 4, 5
    EXPECT_EQ(resizeImageMap(map, 4, 4).values, map.values);
}

} // namespace
} // namespace celadon::subedit
