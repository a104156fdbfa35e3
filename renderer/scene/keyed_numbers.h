#pragma once

#include "renderer/scene/rig.h"

#include <cstddef>
#include <span>
#include <vector>

/// Numbers that may change over time, as deformers have them: a constant, or keys. Unlike the
/// splines of a glTF (rig.h), CubicSpline needs no tangents: it passes smoothly through its keys.
namespace celadon {

struct KeyedNumbers {
    std::size_t components = 1;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double> times;       ///< seconds, each after the one before; empty: a constant
    std::vector<double> values{0.0}; ///< [key][components], of one key where there are no times

    /// A constant.
    [[nodiscard]] static KeyedNumbers of(std::span<const double> value);
    [[nodiscard]] static KeyedNumbers of(double value) { return of(std::span(&value, 1)); }
    [[nodiscard]] static KeyedNumbers of(const glm::dvec3& value);

    [[nodiscard]] bool isKeyed() const { return !times.empty(); }
    /// Before the first key and after the last it stays. @param result `components` numbers
    void sample(double seconds, std::span<double> result) const;
    [[nodiscard]] double number(double seconds) const;     ///< of one component
    [[nodiscard]] glm::dvec3 vector(double seconds) const; ///< of three
    [[nodiscard]] double lastSeconds() const { return times.empty() ? 0.0 : times.back(); }

    /// Sets the key at a time, which becomes one if it is none, in place of a constant too.
    void setKey(double seconds, std::span<const double> value);
    /// The last key that is taken away leaves its value as a constant.
    void removeKey(std::size_t index);

    bool operator==(const KeyedNumbers&) const = default;
};

} // namespace celadon
