#pragma once

#include "renderer/gather/pair_kernel.h"
#include "renderer/scene/world.h"

#include <span>
#include <vector>

/// The scene's SubEdit materials as the CPU backend reads them. No GL here.
namespace celadon {

/// Knots that the nodes above level 0 share, on every backend: r_s the largest of the materials,
/// spacing the finest, at most 256 segments.
[[nodiscard]] gather::Knots commonKnots(std::span<const MaterialPointer> materials);

class GatherMaterials {
public:
    /// Keeps pointers: texels edited in place are seen by the next solve, see admit().
    explicit GatherMaterials(std::span<const MaterialPointer> materials);

    /// After an edit. Codes span some more than the largest ln P there was. @return whether they
    /// had to be made anew, all of them
    bool admit(float largestLogP);

    [[nodiscard]] const subedit::MaterialMap& map(int material) const {
        return *mMaterials[static_cast<std::size_t>(material)];
    }
    [[nodiscard]] gather::Profiles profiles() const { return mProfiles; }
    /// One material of one texel: all profiles are one, at code 0.
    [[nodiscard]] bool isHomogeneous() const { return mProfiles == gather::Profiles::One; }
    [[nodiscard]] const gather::Knots& commonKnots() const { return mCommon; }
    [[nodiscard]] gather::Knots knots(int material) const;
    [[nodiscard]] const gather::CodeScale& scale() const { return mScale; }
    /// Codes of the longest profile.
    [[nodiscard]] std::size_t largestProfile() const { return mLargestProfile; }

    /// Codes of the profile at a texture coordinate: [segments + 1][kKnotCodes].
    void encode(int material, glm::vec2 uv, std::uint16_t* codes) const;
    /// sqrt(P) of such a profile on the common knots, zero beyond its own r_s.
    void decodeRoots(int material, const std::uint16_t* codes, float* roots) const;
    /// Codes of numbers given as ln P.
    void encodeLogs(const float* logP, std::size_t count, std::uint16_t* codes) const;

private:
    void update();

    std::vector<MaterialPointer> mMaterials;
    gather::Knots mCommon;
    gather::CodeScale mScale;
    float mLargestLogP = 0.0f; ///< that has a code
    std::size_t mLargestProfile = 0;
    gather::Profiles mProfiles = gather::Profiles::Any;
};

} // namespace celadon
