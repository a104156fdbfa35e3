#include "subedit/medium.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace celadon::subedit {

Medium mediumFromAlbedo(const glm::dvec3& reducedAlbedo, const glm::dvec3& meanFreePathMm,
                        double eta) {
    const glm::dvec3 extinction = 1.0 / meanFreePathMm;
    return {(1.0 - reducedAlbedo) * extinction, reducedAlbedo * extinction, eta};
}

void validateMedium(const Medium& medium) {
    if (!std::isfinite(medium.eta) || medium.eta < 0.5 || medium.eta > 4.0) {
        throw UsageError("index of refraction", fmt::format("{} is not in [0.5, 4]", medium.eta),
                         "water is 1.33, most solids 1.3 to 1.6");
    }
    if (!(medium.anisotropy > -1.0 && medium.anisotropy < 1.0)) {
        throw UsageError("anisotropy g", fmt::format("{} is not in (-1, 1)", medium.anisotropy),
                         "0 scatters evenly, skin has some 0.9");
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double absorption = medium.absorption[channel];
        const double scattering = medium.reducedScattering[channel];
        if (!std::isfinite(absorption) || absorption < 0.0) {
            throw UsageError("absorption", fmt::format("{} is {}, not a finite number >= 0 (1/mm)",
                                                       channelName(channel), absorption));
        }
        if (!std::isfinite(scattering) || scattering <= 0.0) {
            throw UsageError("reduced scattering",
                             fmt::format("{} is {}, not a finite number > 0 (1/mm)",
                                         channelName(channel), scattering));
        }
    }
}

const char* channelName(int channel) {
    constexpr const char* kNames[] = {"red", "green", "blue"};
    return kNames[channel];
}

} // namespace celadon::subedit
