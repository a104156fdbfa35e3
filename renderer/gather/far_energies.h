#pragma once

#include "renderer/gather/changed_texels.h"
#include "renderer/gather/four.h"
#include "renderer/scene/world.h"
#include "subedit/map/texel_rect.h"

#include <cstdint>
#include <functional>
#include <list>
#include <span>
#include <vector>

namespace celadon {

/// ln of the energy that each texel's profile has beyond a few radii, per channel: what the
/// accumulation divides out (TexelTables::logFarEnergy). It lies elsewhere; of its knots, those
/// about the radii are held here. No GL here.
class FarEnergies {
public:
    /// Copies what a rectangle of a material's map has at a knot: half-precision bits,
    /// [height][width][4].
    using Source = std::function<void(int material, int knot, const subedit::TexelRect& rect,
                                      std::span<std::uint16_t> halves)>;

    /// What is there at some radii. Valid until the next select() or changed().
    class Selection {
    public:
        /// R, G, B at a texture coordinate, which repeats: bilinear over the map, linear along the
        /// knots, as logFarEnergy() of shaders/include/material.glsl.
        [[nodiscard]] Four at(std::size_t radius, int material, glm::vec2 uv) const;

    private:
        friend class FarEnergies;
        struct Slice {
            const std::uint16_t* before; ///< [height][width][4] at the knot before the radius,
            const std::uint16_t* after;  ///< at the one after it,
            float along;                 ///< and how far it is from the one to the other
        };
        std::vector<glm::ivec2> mSizes; ///< of the materials' maps
        std::vector<Slice> mSlices;     ///< [radius][material]
    };

    explicit FarEnergies(std::span<const MaterialPointer> materials);

    /// Texels were edited.
    void changed(int material, const subedit::TexelRect& rect);
    /// Reads what is not held, or has changed. @param radiiMm those that are asked for next
    [[nodiscard]] Selection select(std::span<const float> radiiMm, const Source& source);

private:
    /// What a material has at a knot.
    struct Plane {
        int material, knot;
        std::uint64_t selected;            ///< when it was used last
        std::vector<TexelChange> changed;  ///< since it was read
        std::vector<std::uint16_t> halves; ///< [height][width][4]
    };
    const std::uint16_t* planeAt(int material, int knot, const Source& source);
    void dropUnused();
    [[nodiscard]] const subedit::MaterialMap& mapOf(int material) const {
        return *mMaterials[static_cast<std::size_t>(material)];
    }

    std::vector<MaterialPointer> mMaterials;
    std::list<Plane> mPlanes;
    std::uint64_t mSelected = 0;
    std::vector<std::uint16_t> mRead;
};

} // namespace celadon
