#pragma once

#include <glm/vec2.hpp>

#include <vector>

/// A smooth plane curve through given points, by arc length: the outlines of builtin sculptures.
namespace celadon {

/// A natural cubic spline over the points' centripetal distances.
class ProfileCurve {
public:
    /// @param points at least two, consecutive ones different
    explicit ProfileCurve(const std::vector<glm::dvec2>& points);

    [[nodiscard]] double length() const { return mLength.back(); }
    [[nodiscard]] glm::dvec2 at(double arcLength) const;      ///< clamped to the ends
    [[nodiscard]] glm::dvec2 tangent(double arcLength) const; ///< unit length

    /// Arc length where the curve first reaches a height.
    [[nodiscard]] double atHeight(double y) const;

private:
    std::vector<glm::dvec2> mSamples; ///< dense
    std::vector<double> mLength;      ///< arc length at each sample
};

} // namespace celadon
