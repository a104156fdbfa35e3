#include "subedit/map/medium_bake.h"
#include "subedit/models/half_space.h"
#include "subedit/models/photon_beam.h"
#include "subedit/presets.h"
#include "subedit/radius_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace celadon::subedit {
namespace {

MediumMap mapOf(const std::vector<Medium>& media) {
    MediumMap map;
    map.width = static_cast<int>(media.size());
    map.height = 1;
    map.eta = static_cast<float>(media.front().eta);
    for (const Medium& medium : media) {
        map.absorption.emplace_back(medium.absorption);
        map.reducedScattering.emplace_back(medium.reducedScattering);
    }
    return map;
}

TEST(MediumBake, TexelsHaveTheExactAlbedoAndTheBeamsRange) {
    const std::vector<Medium> media{findMediumPreset("skin1"), findMediumPreset("wholemilk"),
                                    findMediumPreset("ketchup"), findMediumPreset("chicken1")};
    const MaterialMap map = bakeMedia(mapOf(media), {.segments = 48});
    for (int x = 0; x < map.width; ++x) {
        const Medium& medium = media[static_cast<std::size_t>(x)];
        const glm::dvec3 albedo = diffuseAlbedo(profileAt(map, x, 0));
        const glm::dvec3 exact = halfSpaceTotal(medium);
        const glm::dvec3 radius = effectiveRadiusMm(profileAt(map, x, 0));
        const RadialCurves beam = photonBeamProfile(medium);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(albedo[c], exact[c], 2e-3) << x;
            const double expected = radiusHolding(beam[static_cast<std::size_t>(c)], 0.95);
            // Within what a segment resolves.
            EXPECT_NEAR(radius[c], expected,
                        0.03 * expected + 0.6 * static_cast<double>(map.maxRadiusMm) / 48.0)
                << x << ' ' << c;
        }
    }
}

TEST(MediumBake, ScalingCoefficientsScalesLengths) {
    MediumMap media = mapOf({findMediumPreset("skin1"), findMediumPreset("skin2")});
    const MaterialMap one = bakeMedia(media);
    for (std::size_t i = 0; i < 2; ++i) {
        media.absorption[i] *= 0.5f;
        media.reducedScattering[i] *= 0.5f;
    }
    const MaterialMap two = bakeMedia(media);
    EXPECT_NEAR(two.maxRadiusMm / one.maxRadiusMm, 2.0f, 1e-4f);
    EXPECT_NEAR(effectiveRadiusMm(profileAt(two, 0, 0)).x,
                2.0 * effectiveRadiusMm(profileAt(one, 0, 0)).x, 1e-3);
    EXPECT_NEAR(diffuseAlbedo(profileAt(two, 1, 0)).y, diffuseAlbedo(profileAt(one, 1, 0)).y, 1e-4);
}

TEST(MediumBake, MediaAtTheEndsOfTheTable) {
    const Medium clear{glm::dvec3(0.0), glm::dvec3(1.0), 1.3, 0.0};
    const Medium black{glm::dvec3(100.0), glm::dvec3(1e-5), 1.3, 0.0};
    const MaterialMap map = bakeMedia(mapOf({clear, black}), {.maxRadiusMm = 50.0});
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 1.0, 1e-3);
    EXPECT_LT(diffuseAlbedo(profileAt(map, 1, 0)).x, 1e-4);
    for (const float value : map.logProfile) {
        ASSERT_TRUE(std::isfinite(value));
    }
}

} // namespace
} // namespace celadon::subedit
