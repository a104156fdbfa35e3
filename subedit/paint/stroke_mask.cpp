#include "subedit/paint/stroke_mask.h"

#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon::subedit {

namespace {

constexpr float kLeastTexels = 0.9f; ///< of a radius: a dab takes hold of a texel of median size
constexpr float kMostDabsBetweenPoints = 1e5f; ///< no hand does; a file might

/// Weight of a texel whose normal makes this cosine with the dab's: paint ends where the surface
/// turns by 90 degrees from the brush, without an edge.
float facingWeight(float cosine) {
    const float t = std::clamp(cosine / 0.3f, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Falloff at a distance in radii: full within `hardness`, then smooth to 0 at 1.
float falloff(float distance, float hardness) {
    if (distance >= 1.0f) {
        return 0.0f;
    }
    if (distance <= hardness) {
        return 1.0f;
    }
    const float t = (1.0f - distance) / (1.0f - hardness);
    return t * t * (3.0f - 2.0f * t);
}

glm::vec3 normalizedOr(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-12f ? v / length : fallback;
}

} // namespace

StrokeMask::StrokeMask(const Surface& surface, const Brush& brush, const Mirror& mirror)
    : mSurface(surface),
      mBrush(brush),
      mRadiusMm(std::max(brush.radiusMm, kLeastTexels * surface.texelSizeMm())),
      mMirror(mirror),
      mSides(mirroredSides(mirror)),
      mTiles((surface.texelCount() + kTileTexels - 1) / kTileTexels),
      mVisited(surface.texelCount() / 64 + 1) {
    CELADON_ASSERT(brush.radiusMm > 0.0f && brush.spacing > 0.0f);
}

float StrokeMask::weight(Texel texel) const {
    const Texel source = mSurface.sourceOf(texel);
    if (source == Surface::kNone) {
        return 0.0f;
    }
    const Tile* tile = mTiles[source / kTileTexels].get();
    return tile == nullptr ? 0.0f : tile->weight[source % kTileTexels];
}

StrokeMask::Tile& StrokeMask::tileOf(Texel texel) {
    std::unique_ptr<Tile>& tile = mTiles[texel / kTileTexels];
    if (tile == nullptr) {
        tile = std::make_unique<Tile>();
    }
    return *tile;
}

inline bool StrokeMask::visit(Texel texel) {
    std::uint64_t& word = mVisited[texel / 64];
    const std::uint64_t bit = std::uint64_t{1} << (texel % 64);
    if ((word & bit) != 0) {
        return false;
    }
    if (word == 0) {
        mVisitedWords.push_back(texel / 64);
    }
    word |= bit;
    return true;
}

std::vector<StrokeMask::Texel> StrokeMask::takeChanged() {
    ++mChangeRound;
    return std::exchange(mChanged, {});
}

std::optional<StrokePoint> StrokeMask::resolve(const Surface& surface, const StrokePoint& point,
                                               float withinMm) {
    StrokePoint resolved = point;
    if (point.uv) {
        const auto at = [](float u, int size) {
            return std::clamp(static_cast<int>(std::floor(u * static_cast<float>(size))), 0,
                              size - 1);
        };
        const auto texel = static_cast<Texel>(at(point.uv->y, surface.height()) * surface.width() +
                                              at(point.uv->x, surface.width()));
        const Texel source = surface.sourceOf(texel);
        if (source == Surface::kNone) {
            return std::nullopt;
        }
        resolved.positionMm = surface.positionMm(source);
        resolved.normal = surface.normal(source);
    } else if (glm::dot(point.normal, point.normal) <= 0.0f) {
        const auto texel = surface.nearest(point.positionMm, glm::vec3(0.0f), withinMm);
        if (!texel) {
            return std::nullopt;
        }
        resolved.normal = surface.normal(*texel);
    }
    return resolved;
}

void StrokeMask::add(const StrokePoint& given) {
    const auto resolved = resolve(mSurface, given, mRadiusMm);
    if (!resolved) {
        mLast.reset(); // off the surface: the path goes on where it comes back
        mUntilNextMm = 0.0f;
        return;
    }
    const StrokePoint& point = *resolved;
    if (!mLast || point.isLifted) {
        addMirrored({point.positionMm, point.normal, mBrush.flow * point.pressure});
        mUntilNextMm = mBrush.spacing * mRadiusMm;
        mLast = point;
        return;
    }
    const StrokePoint last = *mLast;
    const float length = glm::distance(last.positionMm, point.positionMm);
    const float stepMm = mBrush.spacing * mRadiusMm;
    if (length / stepMm > kMostDabsBetweenPoints) {
        throw InputError("a stroke",
                         fmt::format("needs {:.0f} dabs between two points {:g} mm apart",
                                     length / stepMm, length),
                         "take a larger brush or spacing");
    }
    float along = mUntilNextMm;
    for (; along <= length; along += stepMm) {
        const float t = along / length;
        const glm::vec3 normal = normalizedOr(glm::mix(last.normal, point.normal, t), point.normal);
        glm::vec3 center = glm::mix(last.positionMm, point.positionMm, t);
        // The chord between two points leaves a curved surface: back onto the nearest texel's
        // plane.
        if (const auto texel = mSurface.nearest(center, normal, mRadiusMm)) {
            const glm::vec3& n = mSurface.normal(*texel);
            center -= n * glm::dot(n, center - mSurface.positionMm(*texel));
        }
        addMirrored({center, normal, mBrush.flow * glm::mix(last.pressure, point.pressure, t)});
    }
    mUntilNextMm = along - length;
    mLast = point;
}

void StrokeMask::addMirrored(const Dab& dab) {
    for (const glm::vec3& signs : mSides) {
        addDab({mirrored(mMirror, signs, dab.centerMm), signs * dab.normal, dab.flow});
    }
}

void StrokeMask::addDab(const Dab& dab) {
    const float radius = mRadiusMm;
    const auto seed = mSurface.nearest(dab.centerMm, dab.normal, radius);
    if (!seed || !(dab.flow > 0.0f)) {
        return;
    }
    // The flood may step one texel out of the ball, so that a ball of few texels stays connected.
    const float reach = radius + mSurface.texelSizeMm();
    const auto look = [&](Texel texel) -> Reached {
        return {texel, glm::distance(mSurface.positionMm(texel), dab.centerMm),
                glm::dot(mSurface.normal(texel), dab.normal)};
    };
    mFront.assign(1, look(*seed));
    visit(*seed);
    for (std::size_t i = 0; i < mFront.size(); ++i) {
        const Reached at = mFront[i];
        const float amount =
            dab.flow * falloff(at.distance / radius, mBrush.hardness) * facingWeight(at.cosine);
        if (amount > 0.0f) {
            Tile& tile = tileOf(at.texel);
            float& weight = tile.weight[at.texel % kTileTexels];
            if (weight < mBrush.opacity) {
                weight = std::min(weight + amount * (mBrush.opacity - weight), mBrush.opacity);
                std::uint32_t& changed = tile.changed[at.texel % kTileTexels];
                if (changed != mChangeRound) {
                    changed = mChangeRound;
                    mChanged.push_back(at.texel);
                }
            }
        }
        mSurface.forEachNeighbor(at.texel, [&](Texel neighbor) {
            if (!visit(neighbor)) {
                return; // or found too far: once is enough
            }
            const Reached next = look(neighbor);
            if (next.cosine > 0.0f && next.distance <= reach) {
                mFront.push_back(next);
            }
        });
    }
    for (const Texel word : mVisitedWords) {
        mVisited[word] = 0;
    }
    mVisitedWords.clear();
}

} // namespace celadon::subedit
