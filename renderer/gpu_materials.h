#pragma once

#include "renderer/gather/far_energies.h"
#include "renderer/gather/gather_materials.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/texture.h"
#include "renderer/material_slots.h"
#include "renderer/material_tables.h"
#include "renderer/scene/world.h"
#include "renderer/shading/fresnel.h"
#include "subedit/map/texel_rect.h"

#include <functional>
#include <limits>
#include <span>
#include <vector>

/// The scene's SubEdit materials on the GPU (shaders/include/material.glsl): all of them in one
/// array texture, each with a border of one texel that repeats its other side.
namespace celadon {

/// Told now and then how much is done, 0 to 1, since large maps take seconds. What it throws ends
/// it.
using MakingProgress = std::function<void(float done)>;

class GpuMaterials {
public:
    /// @param energy, epsilon as makeTexelTables, makeMaterialTables
    /// @param tell see MakingProgress; may be empty
    /// @param rangeTable instead of the materials' own, unless empty
    /// @throws InputError when they are too many or too large for the driver
    GpuMaterials(std::span<const MaterialPointer> materials, double energy, double epsilon,
                 ExitFresnel exitFresnel, const MakingProgress& tell = {},
                 std::span<const float> rangeTable = {});

    /// Whether the driver's textures hold them all at once.
    /// @param sizes width, height and knots of each
    [[nodiscard]] static bool hasRoom(std::span<const glm::ivec3> sizes);

    /// Texels of a rectangle have changed. Neither size nor layout of the map may have; the range
    /// table and the means stay as they were made.
    /// @param map as it is now
    void update(int material, const subedit::MaterialMap& map, const subedit::TexelRect& rect);

    /// Textures to units 8.., the uniform block to its binding point.
    void bind() const;
    void bindRangeTable(GLuint unit) const;

    [[nodiscard]] int count() const { return static_cast<int>(mMeanLogProfiles.size()); }
    /// One material of one texel: profiles need no map.
    [[nodiscard]] bool isHomogeneous() const { return mHomogeneous; }
    [[nodiscard]] float meanRadiusMm() const { return mMeanRadiusMm; }
    /// R_P that a quarter of the texels fall below, of the material where it is shortest; as made.
    [[nodiscard]] float shortRadiusMm() const { return mShortRadiusMm; }
    /// Knots that node profiles share.
    [[nodiscard]] const gather::Knots& commonKnots() const { return mCommonKnots; }
    /// ln of the far energy for the processor, which holds what was selected last; reads it back
    /// where it is not there. Of all renderers that share this, one at a time.
    [[nodiscard]] FarEnergies::Selection selectFarEnergies(std::span<const float> radiiMm) const;
    /// Rbar(T) (eq. 14).
    [[nodiscard]] float minimalRadius(float pixelsPerRadius, int material = 0) const;

private:
    /// Of the map's texel (0, 0) and its first layer in the arrays.
    [[nodiscard]] glm::ivec3 cornerOf(int material) const;

    gl::Buffer mBlock;
    MaterialSlots mSlots;
    gl::Texture mTables; ///< [layer][row][column][4]: ln P of the knots, radii, kept energy, lobe
    gl::Texture mFarEnergy; ///< the same places
    mutable FarEnergies mHeldFarEnergies;
    gl::Texture mRangeTable;
    gl::Sampler mMapSampler, mTableSampler;
    std::vector<float> mRangeTables; ///< one row a material
    std::size_t mTableSize = 0;
    std::vector<std::vector<float>> mMeanLogProfiles; ///< per material, for update()
    double mEnergy = 1.0;
    bool mHomogeneous = false;
    float mMeanRadiusMm = 0.0f;
    float mShortRadiusMm = std::numeric_limits<float>::max();
    gather::Knots mCommonKnots;
};

} // namespace celadon
