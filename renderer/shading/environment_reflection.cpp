#include "renderer/shading/environment_reflection.h"

#include "renderer/gl/debug.h"

#include <algorithm>
#include <bit>

namespace celadon {

namespace {

constexpr int kMostMapTexels = 2048; ///< of a row: 0.18 degrees, the eighth of a lobe's width
constexpr int kLeastEdge = 32, kMostEdge = 512; ///< of a face
constexpr int kLobeLevels = 6;                  ///< roughness 0, 0.2, ... 1
constexpr int kTableSize = 64;

/// About the map's own texels.
int faceEdge(const EnvironmentMap& map) {
    const auto half = static_cast<unsigned>(std::clamp(map.height / 2, kLeastEdge, kMostEdge));
    return static_cast<int>(std::bit_ceil(half));
}

gl::Texture uploaded(const EnvironmentMap& map) {
    std::vector<float> texels;
    texels.reserve(4 * map.radiance.size());
    for (const glm::vec3& color : map.radiance) {
        texels.insert(texels.end(), {color.r, color.g, color.b, 1.0f});
    }
    gl::Texture texture =
        gl::Texture::make2d("environment", GL_RGBA32F, glm::ivec2(map.width, map.height));
    texture.upload(0, texels);
    return texture;
}

} // namespace

EnvironmentReflection::EnvironmentReflection(const gl::ShaderLibrary& shaders,
                                             const EnvironmentMap& map)
    : mLobeSampler("environment", gl::Filter::LinearMipmap),
      mTableSampler("albedo of the lobe", gl::Filter::Linear),
      mLobes("environment lobes", faceEdge(map), kLobeLevels) {
    const gl::DebugGroup group("environment reflection");
    EnvironmentMap reduced;
    const EnvironmentMap* source = &map;
    while (source->width > kMostMapTexels || source->height > kMostMapTexels) {
        reduced = halved(*source);
        source = &reduced;
    }

    // The map on a cube, with mips down to one texel.
    const gl::Texture panorama = uploaded(*source);
    const gl::Sampler around("panorama", gl::Filter::Linear, gl::Wrap::Repeat,
                             gl::Wrap::ClampToEdge);
    const int edge = mLobes.edge();
    gl::CubeTexture cube("environment cube", edge, gl::fullLevelCount(glm::ivec2(edge)));
    const gl::Program toCube("environment cube", shaders, {"environment_cube.comp"});
    toCube.use();
    panorama.bind(0);
    around.bind(0);
    cube.bindImage(0, 0);
    toCube.dispatchOver(glm::ivec2(edge), 6);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    gl::Sampler::unbind(0);
    cube.generateMipmaps();

    const gl::Program toLobe("environment lobe", shaders, {"environment_lobe.comp"});
    toLobe.use();
    cube.bind(0);
    mLobeSampler.bind(0);
    for (int level = 0; level < kLobeLevels; ++level) {
        toLobe.set(0, float(level) / float(kLobeLevels - 1));
        mLobes.bindImage(0, level);
        toLobe.dispatchOver(glm::ivec2(mLobes.edge(level)), 6);
    }
    gl::Sampler::unbind(0);

    mAlbedos = gl::Texture::make2d("albedo of the lobe", GL_RG32F, glm::ivec2(kTableSize));
    const gl::Program toTable("albedo of the lobe", shaders, {"lobe_albedo.comp"});
    toTable.use();
    mAlbedos.bindImage(0, 0, GL_WRITE_ONLY);
    toTable.dispatchOver(glm::ivec2(kTableSize));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void EnvironmentReflection::bind(GLuint firstUnit) const {
    mLobes.bind(firstUnit);
    mLobeSampler.bind(firstUnit);
    mAlbedos.bind(firstUnit + 1);
    mTableSampler.bind(firstUnit + 1);
}

} // namespace celadon
