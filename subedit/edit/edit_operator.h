#pragma once

#include "subedit/effective_radius.h"
#include "subedit/paint/brush.h"

#include <glm/vec3.hpp>

#include <array>
#include <string_view>
#include <variant>
#include <vector>

/// What an edit does to the profiles of the texels that it is applied to: a description, without
/// the doing (apply_operator.h). Local appearance is albedo A, effective scattering radius R_P and
/// shape (P in units of A and R_P); operators that change one of them leave the others as they are
/// (Song et al. 2009). All act per channel. A weight w in [0, 1] says how much of it a texel gets:
/// nothing at 0, all at 1.
namespace celadon::subedit {

/// One profile, at any number of knots.
struct StoredProfile {
    int segments = 0;
    float maxRadiusMm = 0.0f;
    std::vector<float> logProfile; ///< (segments + 1) x 3 values of ln P, channel fastest
    [[nodiscard]] ProfileView view() const { return {logProfile.data(), segments, maxRadiusMm}; }
    bool operator==(const StoredProfile&) const = default;
};

/// A becomes A (1 + w (factor - 1)), at most 1.
struct ScaleAlbedo {
    glm::vec3 factor{1.0f}; ///< each >= 0
    bool operator==(const ScaleAlbedo&) const = default;
};

/// A becomes (1 - w) A + w albedo.
struct SetAlbedo {
    glm::vec3 albedo{0.5f}; ///< each in [0, 1]
    bool operator==(const SetAlbedo&) const = default;
};

/// Pulls the color of A towards that of `color`, at the same luminance (Rec. 709), by w * amount.
struct Tint {
    glm::vec3 color{1.0f}; ///< linear, each >= 0, one > 0
    float amount = 1.0f;   ///< in [0, 1]
    bool operator==(const Tint&) const = default;
};

/// P(r) becomes P(r / s) / s^2 with s = factor^w: the range grows, the albedo stays.
struct ScaleRange {
    glm::vec3 factor{1.0f}; ///< each > 0
    bool operator==(const ScaleRange&) const = default;
};

/// R_P becomes R_P^(1 - w) radius^w, by scaling as above.
struct SetRange {
    glm::vec3 radiusMm{1.0f}; ///< R_P (energy 0.95) of each channel, > 0
    bool operator==(const SetRange&) const = default;
};

/// The shape becomes that of a curve: ln P, in units of A and R_P, goes from its own (w = 0) to the
/// curve's (w = 1) linearly.
struct SetShape {
    StoredProfile curve; ///< its albedo and range do not matter
    bool operator==(const SetShape&) const = default;
};

/// P becomes (1 - a) P + a Q with a = w * amount: `amount` 1 replaces (fills).
struct Mix {
    StoredProfile profile; ///< Q
    float amount = 1.0f;   ///< in [0, 1]
    bool operator==(const Mix&) const = default;
};

/// As Mix with amount 1, of a profile that goes from one to another along a line in space: between
/// them ln P is interpolated linearly.
struct Gradient {
    StoredProfile from;
    StoredProfile to;
    glm::vec3 fromMm{0.0f};
    glm::vec3 toMm{1.0f, 0.0f, 0.0f}; ///< apart from `fromMm`
    bool operator==(const Gradient&) const = default;
};

/// Differences from the local mean of ln P become 1 + w * amount times as large: -1 smooths them
/// away, 1 doubles them.
struct Heterogeneity {
    float amount = 0.5f;   ///< in [-1, 4]
    float radiusMm = 5.0f; ///< of the neighborhood that the mean is taken over, on the surface
    bool operator==(const Heterogeneity&) const = default;
};

/// Where something is taken from: as if the surface around `from` were laid onto that around `to`,
/// normal on normal, turned about it by an angle.
struct Placement {
    StrokePoint from; ///< pressure does not matter
    StrokePoint to;
    float angleDegrees = 0.0f; ///< counter-clockwise, seen from outside
    bool operator==(const Placement&) const = default;
};

/// As Mix with amount 1, of the profile at the place that lies there.
struct Clone {
    Placement placement;
    bool operator==(const Clone&) const = default;
};

/// The heterogeneity of another place on the base of this one: ln P becomes the local mean here
/// plus the difference from the local mean there (pattern transfer).
struct TransferPattern {
    Placement placement;
    float radiusMm = 5.0f; ///< of the neighborhoods that the means are taken over
    float strength = 1.0f; ///< of the pattern, in [0, 4]
    bool operator==(const TransferPattern&) const = default;
};

using EditOperator = std::variant<ScaleAlbedo, SetAlbedo, Tint, ScaleRange, SetRange, SetShape, Mix,
                                  Gradient, Heterogeneity, Clone, TransferPattern>;

/// A texel's result depends on that texel alone.
[[nodiscard]] inline bool isLocal(const EditOperator& op) {
    return !std::holds_alternative<Heterogeneity>(op) && !std::holds_alternative<Clone>(op) &&
           !std::holds_alternative<TransferPattern>(op);
}

/// As in files, in the order of EditOperator.
inline constexpr std::array<std::string_view, std::variant_size_v<EditOperator>> kOperatorNames{
    "scale-albedo", "set-albedo", "tint",          "scale-range", "set-range",       "set-shape",
    "mix",          "gradient",   "heterogeneity", "clone",       "transfer-pattern"};

[[nodiscard]] inline std::string_view operatorName(const EditOperator& op) {
    return kOperatorNames[op.index()];
}

} // namespace celadon::subedit
