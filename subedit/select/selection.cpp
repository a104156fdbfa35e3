#include "subedit/select/selection.h"

#include "subedit/errors.h"
#include "subedit/paint/stroke_mask.h"
#include "subedit/paint/surface_distance.h"
#include "subedit/select/profile_distance.h"
#include "subedit/select/weight_filter.h"
#include "subedit/stop_point.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace celadon::subedit {

namespace {

using Weight = WeightMask::Weight;

/// 1 at 0, 0 from 1 on, smooth at both ends.
float smoothFall(float t) {
    const float x = 1.0f - std::clamp(t, 0.0f, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

WeightMask strokeWeights(const Surface& surface, const SelectStroke& step) {
    StrokeMask dabs(surface, step.brush, step.mirror);
    for (const StrokePoint& point : step.path) {
        dabs.add(point);
    }
    WeightMask mask(surface.width(), surface.height());
    for (const Surface::Texel texel : dabs.takeChanged()) {
        mask.set(std::size_t{texel}, weightFromFloat(dabs.weight(texel)));
    }
    return mask;
}

Surface::Texel texelAt(const Surface& surface, const StrokePoint& point) {
    const float reach = 4.0f * surface.texelSizeMm();
    if (const auto resolved = StrokeMask::resolve(surface, point, reach)) {
        if (const auto texel = surface.nearest(resolved->positionMm, resolved->normal, reach)) {
            return *texel;
        }
    }
    throw InputError(
        "the point of a selection by similarity",
        point.uv
            ? fmt::format("texture coordinate ({}, {}) is on no surface", point.uv->x, point.uv->y)
            : fmt::format("({}, {}, {}) mm is not on the surface", point.positionMm.x,
                          point.positionMm.y, point.positionMm.z));
}

WeightMask similarWeights(const MaterialMap& map, const Surface& surface,
                          const SelectSimilar& step) {
    const Surface::Texel center = texelAt(surface, step.point);
    const ProfileLayout layout = layoutOf(map);
    std::vector<float> distance;
    if (step.withinMm) {
        distance = surfaceDistanceMm(surface, {&center, 1}, *step.withinMm);
    }
    const float* reference = map.logProfile.data() + center * layout.values();
    std::vector<Weight> weights(surface.texelCount(), 0);
    const auto texels = surface.coveredTexels();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, texels.size(), 1024),
        [&](const tbb::blocked_range<std::size_t>& range) {
            ProfileDistance metric(reference, layout);
            const float hard = step.tolerance * (1.0f - step.softness);
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const Surface::Texel texel = texels[i];
                float weight = 1.0f;
                if (step.withinMm) {
                    weight = smoothFall(distance[texel] / *step.withinMm);
                }
                if (weight > 0.0f) {
                    const float d = metric(map.logProfile.data() + texel * layout.values());
                    // At softness 0 the edge is a step: `tolerance` itself is outside.
                    weight *= d <= hard && d < step.tolerance
                                  ? 1.0f
                                  : (d >= step.tolerance
                                         ? 0.0f
                                         : smoothFall((d - hard) / (step.tolerance - hard)));
                }
                weights[texel] = weightFromFloat(weight);
            }
        });
    stopPoint();
    WeightMask mask(surface.width(), surface.height());
    for (const Surface::Texel texel : texels) {
        mask.set(std::size_t{texel}, weights[texel]);
    }
    return mask;
}

/// Weight by weight.
template<typename Function>
WeightMask combine(const WeightMask& a, const WeightMask& b, const Function& function) {
    WeightMask result(a.width(), a.height());
    static const WeightMask::Tile kZero{};
    for (int t = 0; t < a.tileCount(); ++t) {
        const WeightMask::Tile& x = a.tile(t) != nullptr ? *a.tile(t) : kZero;
        const WeightMask::Tile& y = b.tile(t) != nullptr ? *b.tile(t) : kZero;
        WeightMask::Tile& out = result.editTile(t);
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = function(x[i], y[i]);
        }
    }
    return result;
}

WeightMask joined(const WeightMask& selection, const WeightMask& found, SelectMode mode) {
    switch (mode) {
    case SelectMode::Replace:
        break;
    case SelectMode::Add:
        return combine(selection, found, [](Weight a, Weight b) { return std::max(a, b); });
    case SelectMode::Subtract:
        return combine(selection, found, [](Weight a, Weight b) {
            return std::min(a, static_cast<Weight>(WeightMask::kFull - b));
        });
    case SelectMode::Intersect:
        return combine(selection, found, [](Weight a, Weight b) { return std::min(a, b); });
    }
    return found;
}

WeightMask inverted(const WeightMask& mask) {
    return combine(mask, mask,
                   [](Weight a, Weight) { return static_cast<Weight>(WeightMask::kFull - a); });
}

struct StepVisitor {
    const MaterialMap& map;
    const Surface& surface;
    const WeightMask& selection;
    SelectMode mode;

    WeightMask operator()(const SelectAll&) const {
        return WeightMask::full(map.width, map.height);
    }
    WeightMask operator()(const SelectNone&) const { return {map.width, map.height}; }
    WeightMask operator()(const InvertSelection&) const { return inverted(selection); }
    WeightMask operator()(const SelectStroke& step) const {
        return join(strokeWeights(surface, step));
    }
    WeightMask operator()(const SelectSimilar& step) const {
        return join(similarWeights(map, surface, step));
    }
    WeightMask operator()(const Propagation& step) const {
        return join(propagate(map, surface, step));
    }
    WeightMask operator()(const GrowSelection& step) const {
        return growWeights(surface, selection, step.distanceMm);
    }
    WeightMask operator()(const ShrinkSelection& step) const {
        return inverted(growWeights(surface, inverted(selection), step.distanceMm));
    }
    WeightMask operator()(const FeatherSelection& step) const {
        return featherWeights(surface, selection, step.distanceMm);
    }

    [[nodiscard]] WeightMask join(WeightMask found) const {
        repeatInGutters(surface, found);
        return joined(selection, found, mode);
    }
};

} // namespace

WeightMask select(const MaterialMap& map, const Surface& surface, const WeightMask& selection,
                  const SelectionStep& step, SelectMode mode) {
    WeightMask result = std::visit(StepVisitor{map, surface, selection, mode}, step);
    result.compact(selection);
    return result;
}

} // namespace celadon::subedit
