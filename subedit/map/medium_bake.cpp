#include "subedit/map/medium_bake.h"

#include "subedit/assert.h"
#include "subedit/fit/albedo_shift.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/half_space.h"
#include "subedit/models/photon_beam.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace celadon::subedit {

namespace {

constexpr int kAlbedos = 96;      ///< steps of sqrt(1 - alpha'), in which profiles vary evenly
constexpr double kPerUnit = 32.0; ///< steps of ln(mean free path) in a factor of e
constexpr double kHeldEnergy = 0.999;

/// Where one channel of a texel is in the tables.
struct Place {
    double albedo; ///< sqrt(1 - alpha') * kAlbedos
    double logLength;
};

Place placeOf(const MediumMap& media, std::size_t texel, int channel) {
    const double a = static_cast<double>(media.absorption[texel][channel]);
    const double s = static_cast<double>(media.reducedScattering[texel][channel]);
    return {std::sqrt(a / (a + s)) * kAlbedos, -std::log(a + s)};
}

template<typename Visit>
void forEachPlace(const MediumMap& media, const Visit& visit) {
    for (std::size_t texel = 0; texel < media.absorption.size(); ++texel) {
        for (int channel = 0; channel < 3; ++channel) {
            visit(placeOf(media, texel, channel));
        }
    }
}

/// Photon beam diffusion at a mean free path of 1, at the albedos that a map needs. Lengths scale:
/// P(r; l) = P(r / l; 1) / l^2.
class BeamCurves {
public:
    explicit BeamCurves(const MediumMap& media) {
        int first = kAlbedos;
        int last = 0;
        forEachPlace(media, [&](const Place& place) {
            first = std::min(first, static_cast<int>(place.albedo));
            last = std::max(last, static_cast<int>(place.albedo) + 1);
        });
        mFirst = std::min(first, kAlbedos - 1);
        mEntries.resize(static_cast<std::size_t>(std::min(last, kAlbedos) - mFirst + 1));
        tbb::parallel_for(std::size_t{0}, mEntries.size(), [&](std::size_t i) {
            const double x = (mFirst + static_cast<double>(i)) / kAlbedos;
            const double albedo = std::clamp(1.0 - x * x, 1e-7, 1.0);
            const auto eta = static_cast<double>(media.eta);
            Entry& entry = mEntries[i];
            const RadialCurve curve =
                photonBeamProfile(mediumFromAlbedo(glm::dvec3(albedo), glm::dvec3(1.0), eta))[0];
            entry.curveTotal = curve.total;
            entry.total = halfSpaceTotal(albedo, eta);
            entry.reach = radiusHolding(curve, kHeldEnergy);
            for (std::size_t sample = 0; sample < kSamples; ++sample) {
                const double r = std::exp(kFirstLog + static_cast<double>(sample) / kPerLogRadius);
                entry.logP[sample] = std::log(std::max(curve.reflectance(r), 1e-300));
            }
        });
    }

    struct Between {
        std::size_t first;
        double t;
    };
    [[nodiscard]] Between between(const Place& place) const {
        const auto first =
            std::min(static_cast<std::size_t>(place.albedo - mFirst), mEntries.size() - 2);
        return {first, place.albedo - mFirst - static_cast<double>(first)};
    }

    [[nodiscard]] std::size_t count() const { return mEntries.size(); }
    /// Entry i at a mean free path, of albedo 1.
    [[nodiscard]] RadialCurve curve(std::size_t i, double lengthMm) const {
        const Entry& entry = mEntries[i];
        const double scale = 1.0 / (entry.curveTotal * lengthMm * lengthMm);
        return {
            [&entry, scale, lengthMm](double r) { return scale * entry.reflectance(r / lengthMm); },
            {},
            1.0};
    }
    [[nodiscard]] double total(const Place& place) const {
        const Between at = between(place);
        return std::lerp(mEntries[at.first].total, mEntries[at.first + 1].total, at.t);
    }
    /// Radius that holds kHeldEnergy, mm.
    [[nodiscard]] double reachMm(const Place& place) const {
        const Between at = between(place);
        return std::exp(place.logLength) *
               std::max(mEntries[at.first].reach, mEntries[at.first + 1].reach);
    }

private:
    static constexpr double kFirstLog = -12.0; ///< ln of the smallest radius, in mean free paths
    static constexpr double kPerLogRadius = 24.0;
    static constexpr std::size_t kSamples = 505; ///< up to e^9 = 8000 mean free paths

    /// ln P over ln r: evaluating the model for every fit would take a minute.
    struct Entry {
        std::array<double, kSamples> logP{};
        double curveTotal = 0.0;
        double total = 0.0; ///< exact
        double reach = 0.0; ///< in mean free paths

        [[nodiscard]] double reflectance(double r) const {
            if (r <= 0.0) {
                return std::numeric_limits<double>::infinity();
            }
            const double position =
                std::clamp((std::log(r) - kFirstLog) * kPerLogRadius, 0.0, kSamples - 1.001);
            const auto i = static_cast<std::size_t>(position);
            return std::exp(std::lerp(logP[i], logP[i + 1], position - static_cast<double>(i)));
        }
    };
    int mFirst = 0;
    std::vector<Entry> mEntries;
};

/// Fitted profiles over albedo and mean free path, between which texels interpolate ln P: a map
/// costs no fit per texel.
class FittedBeams {
public:
    FittedBeams(const MediumMap& media, const BeamCurves& curves, int segments, double maxRadiusMm)
        : mCurves(curves), mKnots(static_cast<std::size_t>(segments) + 1) {
        double last = -std::numeric_limits<double>::infinity();
        mFirstLog = -last;
        forEachPlace(media, [&](const Place& place) {
            mFirstLog = std::min(mFirstLog, place.logLength);
            last = std::max(last, place.logLength);
        });
        mLengths = static_cast<std::size_t>(std::ceil((last - mFirstLog) * kPerUnit)) + 2;
        mLogP.resize(curves.count() * mLengths * mKnots);
        tbb::parallel_for(std::size_t{0}, curves.count() * mLengths, [&](std::size_t i) {
            const double length =
                std::exp(mFirstLog + static_cast<double>(i % mLengths) / kPerUnit);
            static_cast<void>(fitChannel(curves.curve(i / mLengths, length), segments, maxRadiusMm,
                                         mLogP.data() + i * mKnots));
        });
    }

    /// @param out ln P at the knots; its albedo is near 1
    void interpolate(const Place& place, double* out) const {
        const BeamCurves::Between albedo = mCurves.between(place);
        const double position = (place.logLength - mFirstLog) * kPerUnit;
        const std::size_t length = std::min(static_cast<std::size_t>(position), mLengths - 2);
        const double t = position - static_cast<double>(length);
        const double* a = mLogP.data() + (albedo.first * mLengths + length) * mKnots;
        const double* b = a + mLengths * mKnots;
        for (std::size_t k = 0; k < mKnots; ++k) {
            out[k] = std::lerp(std::lerp(a[k], a[k + mKnots], t), std::lerp(b[k], b[k + mKnots], t),
                               albedo.t);
        }
    }

private:
    const BeamCurves& mCurves;
    std::size_t mKnots;
    double mFirstLog = 0.0;
    std::size_t mLengths = 0;
    std::vector<double> mLogP;
};

} // namespace

MaterialMap bakeMedia(const MediumMap& media, const BakeSettings& settings) {
    const std::size_t texels = media.absorption.size();
    CELADON_ASSERT(texels > 0 && media.reducedScattering.size() == texels);
    const BeamCurves curves(media);
    double maxRadiusMm = settings.maxRadiusMm;
    if (maxRadiusMm <= 0.0) {
        forEachPlace(media, [&](const Place& place) {
            maxRadiusMm = std::max(maxRadiusMm, curves.reachMm(place));
        });
    }
    MaterialMap map;
    map.width = media.width;
    map.height = media.height;
    map.segments = settings.segments;
    map.maxRadiusMm = static_cast<float>(maxRadiusMm);
    map.eta = media.eta;
    map.roughness = media.roughness;
    const auto knots = static_cast<std::size_t>(map.knots());
    map.logProfile.resize(texels * knots * 3);
    const FittedBeams fitted(media, curves, settings.segments, maxRadiusMm);
    tbb::parallel_for(std::size_t{0}, texels, [&](std::size_t texel) {
        std::vector<double> logP(knots);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Place place = placeOf(media, texel, static_cast<int>(channel));
            fitted.interpolate(place, logP.data());
            const double shift = albedoShift(logP.data(), 1, settings.segments, maxRadiusMm,
                                             std::max(curves.total(place), 1e-12));
            for (std::size_t k = 0; k < knots; ++k) {
                map.logProfile[(texel * knots + k) * 3 + channel] =
                    std::max(static_cast<float>(logP[k] + shift), kLogProfileFloor);
            }
        }
    });
    return map;
}

} // namespace celadon::subedit
