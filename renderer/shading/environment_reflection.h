#pragma once

#include "renderer/gl/cube_texture.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/environment.h"

/// What the specular lobe sees of an environment map, by the split sum (Karis 2013, "Real shading
/// in Unreal Engine 4"): the map averaged under a GGX lobe, for several roughnesses, in the levels
/// of a cube; and the lobe's albedo under uniform light, a F0 + b, in a table. Both are integrated
/// once, by importance sampling whose samples look up what their share of the lobe covers (Krivanek
/// and Colbert 2008), so that a small sun leaves neither sparkle nor copies of itself.
namespace celadon {

class EnvironmentReflection {
public:
    /// @throws ContextError when the GPU's memory does not hold it
    EnvironmentReflection(const gl::ShaderLibrary& shaders, const EnvironmentMap& map);

    /// The map's levels at unit kFirstUnit, the table at the next.
    void bind(GLuint firstUnit) const;
    /// RGBA32F cube: level l is the map under a lobe of roughness l / (levels - 1), radiance.
    [[nodiscard]] const gl::CubeTexture& lobes() const { return mLobes; }
    /// RG32F over (n.v, roughness): a, b.
    [[nodiscard]] const gl::Texture& albedos() const { return mAlbedos; }

private:
    gl::Sampler mLobeSampler, mTableSampler;
    gl::CubeTexture mLobes;
    gl::Texture mAlbedos;
};

} // namespace celadon
