#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

/// A SubEdit material (DESIGN section 2): a map over the surface whose every texel holds a
/// scattering profile, piecewise linear in ln P on `segments` equal pieces of [0, maxRadiusMm]
/// (Song et al. 2009; Chen et al. 2012, eq. 9). Between texels ln P is interpolated bilinearly.
namespace celadon::subedit {

inline constexpr float kLogProfileFloor = -30.0f; ///< P is floored at e^-30 per mm^2
inline constexpr int kMaxSegments = 256;

struct MaterialMap {
    std::string name;
    int width = 0;            ///< texels, >= 1; 1x1 is a homogeneous material
    int height = 0;           ///< texels, >= 1; row 0 is the top (v = 0)
    int segments = 0;         ///< n, 1..256; a profile has n + 1 knots r_k = k r_s / n
    float maxRadiusMm = 0.0f; ///< r_s, mm, > 0; P is zero beyond
    float eta = 1.3f;         ///< relative index of refraction of the surface

    /// ln P at the knots, P in 1/mm^2: shape [height][width][segments + 1][3], channel fastest.
    std::vector<float> logProfile;

    std::vector<float> roughness; ///< [height][width] in [0, 1], or empty
    std::vector<float> specular;  ///< [height][width] in [0, 1], or empty

    [[nodiscard]] int knots() const { return segments + 1; }
    [[nodiscard]] bool isHomogeneous() const { return width == 1 && height == 1; }

    /// Index of ln P of texel (x, y), knot k, red.
    [[nodiscard]] std::size_t index(int x, int y, int k) const {
        return ((static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)) *
                    static_cast<std::size_t>(segments + 1) +
                static_cast<std::size_t>(k)) *
               3;
    }
    [[nodiscard]] glm::vec3 logKnot(int x, int y, int k) const {
        const float* p = logProfile.data() + index(x, y, k);
        return {p[0], p[1], p[2]};
    }

    /// ln P of every knot at texture coordinate uv (repeating, v down, texel centers at
    /// (i + 1/2) / size), bilinear in ln P.
    /// @param out knots() * 3 values, channel fastest
    void sampleLogProfile(glm::vec2 uv, float* out) const;
};

} // namespace celadon::subedit
