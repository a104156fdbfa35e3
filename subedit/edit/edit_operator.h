#pragma once

#include "subedit/effective_radius.h"

#include <glm/vec3.hpp>

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

using EditOperator =
    std::variant<ScaleAlbedo, SetAlbedo, Tint, ScaleRange, SetRange, SetShape, Mix, Gradient>;

/// As in files: "scale-albedo", "mix", ...
[[nodiscard]] std::string_view operatorName(const EditOperator& op);

} // namespace celadon::subedit
