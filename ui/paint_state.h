#pragma once

#include "subedit/document/edit_command.h"
#include "subedit/edit/edit_operator.h"
#include "subedit/map/material_map.h"
#include "subedit/paint/brush.h"
#include "subedit/select/propagation.h"
#include "subedit/select/selection.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the hand holds: a tool, an operator, a brush and two profiles. Data only.
namespace celadon::ui {

enum class Tool {
    Paint,    ///< strokes with the operator
    Select,   ///< strokes whose paint is selection
    Similar,  ///< selects what is like the place that is clicked
    Pick,     ///< takes the profile under the cursor
    Scribble, ///< rough strokes that propagation spreads to whatever resembles them
    Stamp     ///< a click lays a picture onto the surface
};

/// The operators of subedit/edit, as a palette shows them.
enum class PaintOperator {
    Profile,     ///< mixes in the primary profile
    ScaleAlbedo, ///< lighter, darker
    SetAlbedo,
    Tint,
    ScaleRange, ///< softer, harder
    SetRange,
    Shape,    ///< of the primary profile, albedo and range stay
    Enhance,  ///< stronger or weaker differences from the neighborhood
    Gradient, ///< from the primary profile to the secondary one along a line in space
    Clone,    ///< copies from another place
    Pattern   ///< copies the differences of another place only
};

struct PaintOperatorName {
    PaintOperator op;
    std::string_view word; ///< in commands
    std::string_view edit; ///< of subedit/edit that it is, as in files
    const char* label;
    const char* inverse; ///< what it does with Ctrl; null: nothing else
    const char* help;
};
[[nodiscard]] std::span<const PaintOperatorName> paintOperators();
[[nodiscard]] const PaintOperatorName& paintOperator(PaintOperator op);
/// @throws UsageError
[[nodiscard]] PaintOperator parsePaintOperator(std::string_view word);

/// For a menu, with the names of the palette: "Soften stroke".
[[nodiscard]] std::string editTitle(const subedit::EditCommand& command);

struct NamedProfile {
    std::string name;
    subedit::StoredProfile profile;
};

/// A picture to be stamped, as weights.
struct StampImage {
    std::string name;
    int width = 0, height = 0;         ///< pixels
    std::vector<std::uint8_t> weights; ///< [height][width], top row first
    [[nodiscard]] bool isSet() const { return !weights.empty(); }
};

struct PaintState {
    Tool tool = Tool::Paint;
    PaintOperator op = PaintOperator::Profile;
    subedit::Brush brush;
    bool mirror[3] = {false, false, false};
    bool heedsPressure = true;            ///< a pen's pressure scales the flow
    float amount = 1.0f;                  ///< of Profile and Tint
    float albedoFactor = 1.25f;           ///< of ScaleAlbedo
    float rangeFactor = 1.5f;             ///< of ScaleRange
    glm::vec3 color{0.85f, 0.35f, 0.25f}; ///< of SetAlbedo (as albedo) and Tint
    glm::vec3 rangeMm{3.0f};              ///< of SetRange
    float enhanceAmount = 0.6f;           ///< of Enhance; negative smooths
    float neighborhoodMm = 6.0f;          ///< of Enhance and Pattern
    float tolerance = 0.12f;              ///< of Similar
    subedit::SelectMode selectMode = subedit::SelectMode::Add;
    std::optional<subedit::StrokePoint> cloneSource; ///< of Clone and Pattern
    std::optional<subedit::StrokePoint> cloneTarget; ///< where the stroke began
    float copyAngleDegrees = 0.0f; ///< of Clone and Pattern: what is copied is turned
    float patternStrength = 1.0f;  ///< of Pattern
    glm::vec3 gradientFromMm{0.0f}, gradientToMm{0.0f}; ///< equal: not drawn yet
    subedit::Propagation propagation;                   ///< its scribbles are those drawn so far
    StampImage stamp;
    float stampAngleDegrees = 0.0f;
    NamedProfile primary;
    NamedProfile secondary;
};

/// Clone and Pattern need both their places, Gradient its line: @throws UsageError
/// @param inverted the other way: factors become their inverse, Profile takes the secondary
[[nodiscard]] subedit::EditOperator makeOperator(const PaintState& state, bool inverted);

/// The profile of one texel.
[[nodiscard]] subedit::StoredProfile storedProfile(const subedit::MaterialMap& map, int x, int y);
/// At texture coordinate uv, interpolated.
[[nodiscard]] subedit::StoredProfile storedProfileAt(const subedit::MaterialMap& map, glm::vec2 uv);
/// Normalized diffusion with this albedo and these effective radii.
[[nodiscard]] subedit::StoredProfile diffusionProfile(const glm::vec3& albedo,
                                                      const glm::vec3& radiusMm);
/// As a material of one texel, for previews.
[[nodiscard]] subedit::MaterialMap homogeneousMaterial(const NamedProfile& profile, float eta);

} // namespace celadon::ui
