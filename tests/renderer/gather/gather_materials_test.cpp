// Profiles as the processor's pair loop reads them.
#include "renderer/gather/gather_materials.h"
#include "tests/support/materials.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace celadon {
namespace {

/// Of any number of segments, and at the last texel of a map too, behind which nothing may be read.
TEST(GatherMaterials, EncodesWhatTheMapHas) {
    for (const int segments : {1, 2, 3, 4, 7, 8, 25, 256}) {
        const MaterialPointer material =
            test::makeMaterial("varied", 5, segments, 12.0f, [](int x, int y) {
                return test::ProfileRecipe{{0.9, 0.5, 0.01}, glm::dvec3(0.3 + 0.2 * x + 0.1 * y)};
            });
        const GatherMaterials materials(std::vector<MaterialPointer>{material});
        const gather::CodeScale& scale = materials.scale();
        const auto knots = static_cast<std::size_t>(material->knots());
        for (const glm::vec2 uv : {glm::vec2(0.9f, 0.9f), glm::vec2(0.0f, 0.31f),
                                   glm::vec2(0.999f, 0.5f), glm::vec2(-2.3f, 7.77f)}) {
            std::vector<std::uint16_t> codes(knots * gather::kKnotCodes);
            std::vector<float> logP(knots * 3);
            materials.encode(0, uv, codes.data());
            material->sampleLogProfile(uv, logP.data());
            for (std::size_t k = 0; k < knots; ++k) {
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(scale.offset + scale.step * static_cast<float>(
                                                                codes[k * gather::kKnotCodes + c]),
                                logP[3 * k + c], 0.55f * scale.step)
                        << segments << " segments, knot " << k;
                }
                EXPECT_EQ(codes[k * gather::kKnotCodes + 3], 0) << "the floor";
            }
        }
    }
}

} // namespace
} // namespace celadon
