#include "ui/paint_state.h"

#include "subedit/errors.h"
#include "subedit/map/material_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr std::array<PaintOperatorName, 11> kOperators{{
    {PaintOperator::Profile, "profile", "mix", "Profile", "secondary profile",
     "Mixes in the primary profile; with Ctrl the secondary one"},
    {PaintOperator::ScaleAlbedo, "scale-albedo", "scale-albedo", "Lighten", "darken",
     "Multiplies the diffuse albedo; range and shape stay. With Ctrl: divides, so it darkens"},
    {PaintOperator::SetAlbedo, "set-albedo", "set-albedo", "Albedo", nullptr,
     "Gives the diffuse albedo of the color below"},
    {PaintOperator::Tint, "tint", "tint", "Tint", nullptr,
     "Pulls the color of the albedo, its luminance stays"},
    {PaintOperator::ScaleRange, "scale-range", "scale-range", "Soften", "harden",
     "Multiplies the effective scattering radius; the albedo stays. With Ctrl: divides, harder"},
    {PaintOperator::SetRange, "set-range", "set-range", "Range", nullptr,
     "Gives the effective scattering radius (R_P, mm) set below"},
    {PaintOperator::Shape, "shape", "set-shape", "Shape", "shape of the secondary",
     "Gives the shape of the primary profile; albedo and range stay"},
    {PaintOperator::Enhance, "enhance", "heterogeneity", "Contrast", "smooth",
     "Makes differences from the neighborhood larger; with Ctrl it smooths them"},
    {PaintOperator::Gradient, "gradient", "gradient", "Gradient", "the other way",
     "From the primary to the secondary profile along a line: Shift+drag over the surface draws "
     "it"},
    {PaintOperator::Clone, "clone", "clone", "Clone", nullptr,
     "Copies the material from another place: Shift+click there first"},
    {PaintOperator::Pattern, "pattern", "transfer-pattern", "Pattern", nullptr,
     "Copies only the pattern of another place onto this base: Shift+click there first"},
}};

} // namespace

std::span<const PaintOperatorName> paintOperators() {
    return kOperators;
}

const PaintOperatorName& paintOperator(PaintOperator op) {
    return *std::ranges::find(kOperators, op, &PaintOperatorName::op);
}

PaintOperator parsePaintOperator(std::string_view word) {
    for (const PaintOperatorName& name : kOperators) {
        if (name.word == word) {
            return name.op;
        }
    }
    throw UsageError(fmt::format("operator '{}'", word), "there is no such operator");
}

std::string editTitle(const subedit::EditCommand& command) {
    return subedit::commandTitle(command, [](const subedit::EditOperator& op) -> std::string_view {
        return std::ranges::find(kOperators, subedit::operatorName(op), &PaintOperatorName::edit)
            ->label;
    });
}

subedit::EditOperator makeOperator(const PaintState& state, bool inverted) {
    const auto factor = [&](float value) { return glm::vec3(inverted ? 1.0f / value : value); };
    const subedit::StoredProfile& profile =
        inverted ? state.secondary.profile : state.primary.profile;
    switch (state.op) {
    case PaintOperator::Profile:
        return subedit::Mix{profile, state.amount};
    case PaintOperator::ScaleAlbedo:
        return subedit::ScaleAlbedo{factor(state.albedoFactor)};
    case PaintOperator::SetAlbedo:
        return subedit::SetAlbedo{state.color};
    case PaintOperator::Tint:
        return subedit::Tint{state.color, state.amount};
    case PaintOperator::ScaleRange:
        return subedit::ScaleRange{factor(state.rangeFactor)};
    case PaintOperator::SetRange:
        return subedit::SetRange{state.rangeMm};
    case PaintOperator::Shape:
        return subedit::SetShape{profile};
    case PaintOperator::Enhance:
        return subedit::Heterogeneity{inverted ? -std::min(1.0f, std::abs(state.enhanceAmount))
                                               : state.enhanceAmount,
                                      state.neighborhoodMm};
    case PaintOperator::Clone:
    case PaintOperator::Pattern: {
        if (!state.cloneSource || !state.cloneTarget) {
            throw UsageError("clone", "there is no place to copy from",
                             "Shift+click on the surface first");
        }
        const subedit::Placement placement{*state.cloneSource, *state.cloneTarget,
                                           state.copyAngleDegrees};
        if (state.op == PaintOperator::Clone) {
            return subedit::Clone{placement};
        }
        return subedit::TransferPattern{placement, state.neighborhoodMm, state.patternStrength};
    }
    case PaintOperator::Gradient:
        if (state.gradientFromMm == state.gradientToMm) {
            throw UsageError("gradient", "there is no line along which it runs",
                             "Shift+drag over the surface first");
        }
        return subedit::Gradient{inverted ? state.secondary.profile : state.primary.profile,
                                 inverted ? state.primary.profile : state.secondary.profile,
                                 state.gradientFromMm, state.gradientToMm};
    }
    return subedit::Mix{profile, state.amount};
}

subedit::StoredProfile storedProfile(const subedit::MaterialMap& map, int x, int y) {
    const float* const first = map.logProfile.data() + map.index(x, y, 0);
    return {map.segments, map.maxRadiusMm, std::vector<float>(first, first + map.knots() * 3)};
}

subedit::StoredProfile storedProfileAt(const subedit::MaterialMap& map, glm::vec2 uv) {
    subedit::StoredProfile profile{map.segments, map.maxRadiusMm, {}};
    profile.logProfile.resize(static_cast<std::size_t>(map.knots()) * 3);
    map.sampleLogProfile(uv, profile.logProfile.data());
    return profile;
}

subedit::StoredProfile diffusionProfile(const glm::vec3& albedo, const glm::vec3& radiusMm) {
    subedit::AppearanceMap appearance;
    appearance.width = appearance.height = 1;
    appearance.albedo = {albedo};
    appearance.effectiveRadius = {radiusMm};
    return storedProfile(subedit::bakeAppearance(appearance), 0, 0);
}

subedit::MaterialMap homogeneousMaterial(const NamedProfile& profile, float eta) {
    subedit::MaterialMap map;
    map.name = profile.name;
    map.width = map.height = 1;
    map.segments = profile.profile.segments;
    map.maxRadiusMm = profile.profile.maxRadiusMm;
    map.eta = eta;
    map.logProfile = profile.profile.logProfile;
    return map;
}

} // namespace celadon::ui
