#pragma once

#include "renderer/gather/four.h"
#include "renderer/scene/world.h"
#include "subedit/map/texel_rect.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace celadon {

/// ln of the energy that each texel's profile has beyond a few radii, per channel: what the
/// accumulation divides out (TexelTables::logFarEnergy). Of the knots, only those about the radii
/// are held. No GL here.
class FarEnergies {
public:
    /// Copies what a rectangle of a material's map has at a knot: half-precision bits,
    /// [height][width][4].
    using Read = std::function<void(int material, int knot, const subedit::TexelRect& rect,
                                    std::span<std::uint16_t> halves)>;

    explicit FarEnergies(std::span<const MaterialPointer> materials);

    /// Texels were edited.
    void changed(int material, const subedit::TexelRect& rect);
    /// The radii that at() is asked for from now on, mm. Reads what is not there, or has changed.
    void setRadii(std::span<const float> radiiMm, const Read& source);
    /// R, G, B at a texture coordinate, which repeats: bilinear over the map, linear along the
    /// knots, as logFarEnergy() of shaders/include/material.glsl.
    [[nodiscard]] Four at(std::size_t radius, int material, glm::vec2 uv) const;

private:
    /// Of one radius and material.
    struct Slice {
        int knot = -1;                     ///< before the radius; -1: nothing was read
        float along = 0.0f;                ///< of the way to the next
        subedit::TexelRect changed;        ///< since it was read
        std::vector<std::uint16_t> halves; ///< [height][width][knot, next knot][4]
    };
    void read(int material, const subedit::TexelRect& rect, const Read& source, Slice& slice);
    [[nodiscard]] const subedit::MaterialMap& mapOf(int material) const {
        return *mMaterials[static_cast<std::size_t>(material)];
    }

    std::vector<MaterialPointer> mMaterials;
    std::vector<Slice> mSlices; ///< [radius][material]
    std::vector<std::uint16_t> mRead;
};

} // namespace celadon
