#include "renderer/reference/medium_walk.h"

#include "renderer/shading/fresnel.h"
#include "subedit/models/walk_steps.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace celadon {

namespace {

constexpr double kRouletteWeight = 0.1;
constexpr double kRouletteSurvival = 0.5;
/// A path without absorption in a large body has no mean length that one can wait for. From this
/// many events on, and at each doubling, a part of the paths ends so that each doubling costs the
/// same.
constexpr std::int64_t kFirstLongPath = 4096;

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

} // namespace

FluxBalance& FluxBalance::operator+=(const FluxBalance& other) {
    entered += other.entered;
    left += other.left;
    lost += other.lost;
    return *this;
}

std::optional<glm::dvec3> refracted(glm::dvec3 toSource, glm::dvec3 normal, double eta) {
    const double cosine = glm::dot(toSource, normal);
    const double squared = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    if (squared <= 0.0) {
        return std::nullopt;
    }
    return glm::normalize(-toSource / eta + (cosine / eta - std::sqrt(squared)) * normal);
}

/// The state of one path.
class MediumWalk::Path {
public:
    Path(const MediumWalk& walk, const LightEntry& entry, Random& random)
        : mWalk(walk),
          mRandom(random),
          mFlux(entry.flux),
          mPosition(walk.mRays.liftedOrigin(entry.point, entry.direction)),
          mDirection(entry.direction),
          mHero(std::min(2, static_cast<int>(3.0 * random.uniform()))) {}

    FluxBalance run(const ExitVisitor& visit) {
        std::int64_t nextDoubling = kFirstLongPath;
        for (std::int64_t event = 1; goesOn(); ++event) {
            step(visit);
            roulette();
            if (event == nextDoubling) {
                nextDoubling *= 2;
                survive(1.0 / std::numbers::sqrt2);
            }
        }
        return mBalance;
    }

private:
    const MediumWalk& mWalk;
    Random& mRandom;
    glm::dvec3 mFlux;
    glm::dvec3 mPosition;
    glm::dvec3 mDirection;
    int mHero;
    int mDepth = 1; ///< bodies that the path is in
    /// Throughput of each channel, and the density with which each, as the hero, would have made
    /// this path: both over the density of the hero that did.
    glm::dvec3 mThroughput{1.0};
    glm::dvec3 mDensity{1.0};
    FluxBalance mBalance;

    [[nodiscard]] bool goesOn() const { return mThroughput != glm::dvec3(0.0); }

    /// Balance heuristic: what each channel carries, over the mean density.
    [[nodiscard]] glm::dvec3 weight() const {
        return mThroughput * (3.0 / (mDensity.x + mDensity.y + mDensity.z));
    }

    void survive(double probability) {
        if (mRandom.uniform() < probability) {
            mThroughput /= probability;
        } else {
            mThroughput = glm::dvec3(0.0);
        }
    }

    void roulette() {
        if (goesOn() && largest(weight()) < kRouletteWeight) {
            survive(kRouletteSurvival);
        }
    }

    void step(const ExitVisitor& visit) {
        const glm::dvec3& sigma_t = mWalk.mExtinction;
        const double length = subedit::freePath(mRandom) / sigma_t[mHero];
        const auto hit = mWalk.mRays.nearest(mPosition, mDirection, length);
        if (!hit) {
            // p(t) = sigma_t exp(-sigma_t t), of each channel over the hero's.
            const glm::dvec3 passed = glm::exp((sigma_t[mHero] - sigma_t) * length);
            mThroughput *= passed * mWalk.mScattering / sigma_t[mHero];
            mDensity *= passed * sigma_t / sigma_t[mHero];
            mPosition += length * mDirection;
            if (glm::distance(mPosition, mWalk.mCenter) > mWalk.mReachMm) {
                lose();
                return;
            }
            mDirection = subedit::scatter(mDirection, mWalk.mMedium.anisotropy, mRandom);
            return;
        }
        const glm::dvec3 passed = glm::exp((sigma_t[mHero] - sigma_t) * hit->distanceMm);
        mThroughput *= passed;
        mDensity *= passed;
        meet(surfacePoint(mWalk.mRays.world(), hit->place), visit);
    }

    void meet(const SurfacePoint& point, const ExitVisitor& visit) {
        const double outwards = glm::dot(mDirection, point.geometricNormal);
        if (point.material < 0) {
            mThroughput = glm::dvec3(0.0); // an opaque part
        } else if (outwards < 0.0) {
            ++mDepth; // into a body that overlaps this one
            mPosition = mWalk.mRays.liftedOrigin(point, mDirection);
        } else if (mDepth > 1) {
            --mDepth;
            mPosition = mWalk.mRays.liftedOrigin(point, mDirection);
        } else {
            meetBoundary(point, visit);
        }
    }

    void meetBoundary(const SurfacePoint& point, const ExitVisitor& visit) {
        const double eta = mWalk.mMedium.eta;
        const double shading = glm::dot(mDirection, point.shadingNormal);
        const bool isShadingUsable = shading > 0.0;
        const double cosine =
            isShadingUsable ? shading : glm::dot(mDirection, point.geometricNormal);
        const double reflectance = eta == 1.0 ? 0.0 : fresnelReflectance(cosine, 1.0 / eta);
        if (reflectance < 1.0) {
            const glm::dvec3 leaving = mFlux * weight() * (1.0 - reflectance);
            mBalance.left += leaving;
            visit(point, leaving);
        }
        mThroughput *= reflectance;
        glm::dvec3 inwards = glm::reflect(mDirection, point.shadingNormal);
        if (!isShadingUsable || glm::dot(inwards, point.geometricNormal) >= 0.0) {
            inwards = glm::reflect(mDirection, point.geometricNormal);
        }
        mDirection = glm::normalize(inwards);
        mPosition = mWalk.mRays.liftedOrigin(point, mDirection);
    }

    void lose() {
        mBalance.lost += mFlux * weight();
        mThroughput = glm::dvec3(0.0);
    }
};

MediumWalk::MediumWalk(const RayScene& rays, const subedit::Medium& medium)
    : mRays(rays),
      mMedium(medium),
      mScattering(medium.reducedScattering / (1.0 - medium.anisotropy)),
      mExtinction(medium.absorption + mScattering),
      mCenter(rays.world().scatteringSphere.center),
      mReachMm(1.01 * rays.world().scatteringSphere.radius) {}

FluxBalance MediumWalk::follow(const LightEntry& entry, Random& random,
                               const ExitVisitor& visit) const {
    FluxBalance balance = Path(*this, entry, random).run(visit);
    balance.entered = entry.flux;
    return balance;
}

} // namespace celadon
