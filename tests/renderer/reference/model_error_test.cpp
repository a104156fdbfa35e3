// What profiles of a half-space miss on a body (the "model error" of the bench), and why: light
// traced in spheres and slabs against diffusion theory in closed form.
//
// Let A be the part of the flux that a half-space returns. With a linear boundary condition the
// absorbed part follows (1 - A) / A = c mu, where mu is how fast the fluence decays behind the
// surface and c what the boundary is like. In a body the decay at the surface is another:
//     sphere of radius R     mu coth(mu R) - 1/R    (it meets itself in the middle)
//     slab of thickness h    mu tanh(mu h / 2)      (both faces together; symmetric light)
// So a convex or thin body absorbs less than a half-space does.
//
// The integral of eq. 4 over a sphere is that over a plane (areas within a chord r are pi r^2 on
// both), so splatted light is A whatever R: too little. Across a slab it adds what a half-space has
// beyond h to what a half-space has, on the other face: too much where walls are thin, twice at
// most.
#include "reference_support.h"
#include "renderer/reference/path_traced.h"
#include "subedit/models/half_space.h"
#include "subedit/models/random_walk.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace celadon {
namespace {

using namespace celadon::testing;
using subedit::Medium;

constexpr double kEta = 1.4;
constexpr glm::dvec3 kTotal{0.95, 0.85, 0.6}; ///< A for perpendicular light

/// Mean free paths of 1 mm.
Medium mediumOfTotals() {
    glm::dvec3 reducedAlbedo;
    for (int c = 0; c < 3; ++c) {
        reducedAlbedo[c] = subedit::reducedAlbedoFromTotal(kTotal[c], kEta);
    }
    return subedit::mediumFromAlbedo(reducedAlbedo, glm::dvec3(1.0), kEta);
}

/// mu in 1/mm far from boundaries: the root of alpha artanh(mu) = mu, isotropic scattering.
double decayPerMm(double alpha) {
    double low = 0.0;
    double high = 1.0 - 1e-12;
    for (int i = 0; i < 100; ++i) {
        const double mu = 0.5 * (low + high);
        (alpha * std::atanh(mu) > mu ? high : low) = mu;
    }
    return low;
}

/// Part of the flux entered that leaves the body again, anywhere.
glm::dvec3 returnedPart(const Mesh& body, const Medium& medium) {
    const World world = makeWorld({{body}}, {makeHomogeneous({1, 1, 1}, 20)});
    const PathTraced solver(world, {.medium = medium, .paths = 40000});
    Camera camera;
    camera.eye = {0, 0, 5000};
    camera.orthographicHeight = 100;
    constexpr glm::ivec2 kPixels(2); // nobody looks
    const std::array lights{directionalLight({0, 0, -1})};
    const PathTracedResult result =
        solver.solve(makeCameraView(camera, kPixels.x, kPixels.y), kPixels, lights);
    return result.flux.left / result.flux.entered;
}

double absorption(double returned) {
    return (1.0 - returned) / returned;
}

TEST(ModelError, SpheresReturnMoreThanTheirProfileAsDiffusionHasIt) {
    const Medium medium = mediumOfTotals();
    constexpr double kLargeMm = 100.0;
    const glm::dvec3 ofLarge = returnedPart(makeSphere(kLargeMm, 80), medium);
    for (const double radius : {50.0, 25.0, 12.5}) {
        const glm::dvec3 returned = returnedPart(makeSphere(radius, 80), medium);
        for (int c = 0; c < 3; ++c) {
            const double mu = decayPerMm(medium.reducedAlbedo()[c]);
            const auto decay = [&](double R) { return mu / std::tanh(mu * R) - 1.0 / R; };
            const double expected = absorption(ofLarge[c]) * decay(radius) / decay(kLargeMm);
            // Beyond diffusion: terms of one mean free path over the radius.
            EXPECT_NEAR(absorption(returned[c]), expected, (0.02 + 1.0 / radius) * expected)
                << radius << ' ' << c;
        }
        if (radius == 50.0) { // the figure that README gives
            EXPECT_NEAR(kTotal.r / returned.r, 0.964, 0.005);
            EXPECT_NEAR(kTotal.g / returned.g, 0.943, 0.008);
            EXPECT_NEAR(kTotal.b / returned.b, 0.935, 0.01);
        }
    }
}

TEST(ModelError, ThinWallsReturnLessThanTheirProfileAsDiffusionHasIt) {
    const Medium medium = mediumOfTotals();
    const subedit::RandomWalkResult walks = subedit::simulateRandomWalk(medium, {.walks = 200000});
    for (const double thickness : {40.0, 20.0, 10.0, 5.0}) {
        const glm::dvec3 returned = returnedPart(makeBox({4000, 4000, thickness}), medium);
        for (int c = 0; c < 3; ++c) {
            const double mu = decayPerMm(medium.reducedAlbedo()[c]);
            const double expected =
                1.0 / (1.0 + absorption(kTotal[c]) * std::tanh(0.5 * mu * thickness));
            // Light enters one mean free path deep, not at the face.
            EXPECT_NEAR(returned[c], expected, (0.004 + mu / thickness) * expected)
                << thickness << ' ' << c;
        }
        // What eq. 4 makes of it: the profile, and on the other face what it has beyond h.
        const subedit::RadialHistogram& red = walks.channels[0];
        double splatted = 2.0 * red.total;
        for (std::size_t i = 0; i < walks.bins() && walks.edgesMm[i + 1] <= thickness; ++i) {
            splatted -= red.energy[i];
        }
        EXPECT_NEAR(splatted / returned.r,
                    thickness == 40.0   ? 1.005
                    : thickness == 20.0 ? 1.065
                    : thickness == 10.0 ? 1.19
                                        : 1.37,
                    0.02)
            << thickness;
    }
}

} // namespace
} // namespace celadon
