#include "subedit/effective_radius.h"

#include "subedit/assert.h"
#include "subedit/log_linear.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

/// A channel that scatters less than this is black: the floor e^-30 of the file would otherwise
/// give it a radius of nearly r_s, which no eye could see and every splat would pay for.
constexpr double kBlackAlbedo = 1e-6;

double knot(const ProfileView& profile, int k, int channel) {
    return static_cast<double>(profile.logProfile[k * 3 + channel]);
}

double segmentWidth(const ProfileView& profile) {
    return static_cast<double>(profile.maxRadiusMm) / profile.segments;
}

double segmentEnergy(const ProfileView& profile, int k, int channel, double t = 1.0) {
    const double h = segmentWidth(profile);
    return pieceEnergy(knot(profile, k, channel), knot(profile, k + 1, channel), k * h, h, t);
}

double channelEnergy(const ProfileView& profile, int channel) {
    double sum = 0.0;
    for (int k = 0; k < profile.segments; ++k) {
        sum += segmentEnergy(profile, k, channel);
    }
    return sum;
}

/// The part t of segment k that holds `energy`: Newton, kept inside a shrinking bracket.
double invertSegment(const ProfileView& profile, int k, int channel, double energy) {
    const double h = segmentWidth(profile);
    const double l0 = knot(profile, k, channel);
    const double l1 = knot(profile, k + 1, channel);
    double low = 0.0;
    double high = 1.0;
    double t = 0.5;
    for (int iteration = 0; iteration < 60 && high - low > 1e-12; ++iteration) {
        const double excess = pieceEnergy(l0, l1, k * h, h, t) - energy;
        (excess > 0.0 ? high : low) = t;
        const double slope = h * h * (k + t) * std::exp(l0 + (l1 - l0) * t);
        const double next = t - excess / slope;
        if (!(next > low && next < high)) {
            t = 0.5 * (low + high);
            continue;
        }
        const bool converged = std::abs(next - t) < 1e-9 * (k + next);
        t = next;
        if (converged) {
            break;
        }
    }
    return t;
}

double channelRadius(const ProfileView& profile, int channel, double energyFraction) {
    const double total = channelEnergy(profile, channel);
    if (2.0 * std::numbers::pi * total < kBlackAlbedo) {
        return 0.0;
    }
    double remaining = total * energyFraction;
    for (int k = 0; k < profile.segments; ++k) {
        const double energy = segmentEnergy(profile, k, channel);
        if (remaining <= energy) {
            return segmentWidth(profile) * (k + invertSegment(profile, k, channel, remaining));
        }
        remaining -= energy;
    }
    return static_cast<double>(profile.maxRadiusMm);
}

} // namespace

glm::dvec3 diffuseAlbedo(const ProfileView& profile) {
    const double twoPi = 2.0 * std::numbers::pi;
    return {twoPi * channelEnergy(profile, 0), twoPi * channelEnergy(profile, 1),
            twoPi * channelEnergy(profile, 2)};
}

glm::dvec3 radialEnergy(const ProfileView& profile, double radiusMm) {
    const double position = std::max(radiusMm, 0.0) / segmentWidth(profile);
    glm::dvec3 sum(0.0);
    for (int k = 0; k < profile.segments && k < position; ++k) {
        const double t = std::min(position - k, 1.0);
        for (int channel = 0; channel < 3; ++channel) {
            sum[channel] += segmentEnergy(profile, k, channel, t);
        }
    }
    return sum;
}

glm::dvec3 effectiveRadiusMm(const ProfileView& profile, double energyFraction) {
    CELADON_ASSERT(energyFraction > 0.0 && energyFraction <= 1.0);
    return {channelRadius(profile, 0, energyFraction), channelRadius(profile, 1, energyFraction),
            channelRadius(profile, 2, energyFraction)};
}

} // namespace celadon::subedit
