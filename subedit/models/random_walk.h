#pragma once

#include "subedit/medium.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

/// Random walks in a semi-infinite scattering medium: radiative transfer itself, no diffusion. It
/// is what the models of a profile are measured against.
namespace celadon::subedit {

enum class LightEntry {
    Pencil, ///< perpendicular, at one point
    Diffuse ///< at one point, cosine-distributed just below the surface ("ideal diffuse")
};

struct RandomWalkSettings {
    std::int64_t walks = 1'000'000;
    std::uint64_t seed = 1;
    LightEntry entry = LightEntry::Pencil;
    /// Called now and then with the part done, in [0, 1], from any thread, one at a time.
    std::function<void(double)> onProgress{};
};

/// Rings on the surface: bin i lies between edges i and i + 1, of which the first is 0; their radii
/// grow by the same factor from the second on.
struct RadialHistogram {
    std::vector<double> energy; ///< part of the flux that entered and leaves in each ring
    std::vector<double> error;  ///< one standard error of `energy`
    double total = 0.0;         ///< all that leaves: the rings, and beyond
    double totalError = 0.0;
};

struct RandomWalkResult {
    std::vector<double> edgesMm;
    std::array<RadialHistogram, 3> channels;

    [[nodiscard]] std::size_t bins() const { return edgesMm.size() - 1; }
    /// Radius that stands for a ring: the geometric mean of its edges.
    [[nodiscard]] double radiusMm(std::size_t bin) const;
    /// P there: energy over area, 1/mm^2, and its standard error.
    [[nodiscard]] double reflectance(int channel, std::size_t bin) const;
    [[nodiscard]] double reflectanceError(int channel, std::size_t bin) const;
};

/// Free paths by sigma_t, Henyey-Greenstein phase function, at the surface exact Fresnel
/// reflectance. Absorption is a weight, and so are the parts that leave and stay when a path meets
/// the surface; light paths end by Russian roulette. One walk, in mean free paths, serves all
/// channels, each with its own albedo and length, so their errors are correlated.
/// The same seed gives the same bits whatever the number of threads.
/// @param medium valid by validateMedium()
[[nodiscard]] RandomWalkResult simulateRandomWalk(const Medium& medium,
                                                  const RandomWalkSettings& settings = {});

} // namespace celadon::subedit
