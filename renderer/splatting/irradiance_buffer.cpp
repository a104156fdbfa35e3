#include "renderer/splatting/irradiance_buffer.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

namespace celadon {

glm::ivec2 paddedSize(glm::ivec2 size, int levels) {
    const int unit = 1 << (levels - 1);
    return (size + unit - 1) / unit * unit;
}

IrradianceBuffer::IrradianceBuffer(const gl::ShaderLibrary& shaders, int materialCount, int size,
                                   int levels, double patchVariance)
    : mSize(size),
      mLevels(levels),
      mPaddedSize(celadon::paddedSize(glm::ivec2(size), levels).x),
      mDraw("irradiance buffer", shaders, SeenFrom::Light, SurfaceDraw::Shows::Geometry,
            "irradiance_buffer.frag",
            {{"MATERIAL_COUNT", std::to_string(materialCount)},
             {"PATCH_VARIANCE", std::to_string(patchVariance)}}),
      mRadii("irradiance radii", shaders, {"irradiance_radii.comp"},
             {{"MATERIAL_COUNT", std::to_string(materialCount)}}),
      mMip("irradiance mip", shaders, {"irradiance_mip.comp"}),
      mRangeMip("depth range mip", shaders, {"depth_range_mip.comp"}) {
    const glm::ivec2 extent(mPaddedSize);
    const char* const names[kTargets] = {"positions",   "normals", "flux",       "surface points",
                                         "covariances", "extents", "kept energy"};
    std::vector<gl::Attachment> colors;
    for (int i = 0; i < kTargets; ++i) {
        mTargets[i] = gl::Texture::make2d(std::string("irradiance buffer: ") + names[i], GL_RGBA32F,
                                          extent, levels);
        colors.push_back({&mTargets[i]});
    }
    mDepth = gl::Texture::make2d("irradiance buffer: depth", GL_DEPTH_COMPONENT32F, extent);
    mDepthRanges = gl::Texture::make2d("irradiance buffer: depth ranges", GL_RG32F, extent, levels);
    mFramebuffer = gl::Framebuffer("irradiance buffer", colors, gl::Attachment{&mDepth});
}

void IrradianceBuffer::draw(const GpuWorld& world) {
    const gl::DebugGroup group("irradiance buffer");
    gl::PassState state;
    state.framebuffer = &mFramebuffer;
    state.viewport = glm::ivec4(0, 0, mSize, mSize); // the padding stays background
    state.depthWrite = true;
    state.depthClamp = true;
    state.apply();
    for (const int i : {0, 2, 3}) { // whoever reads the others asks one of these first
        mFramebuffer.clearColor(i, i == 3 ? glm::vec4(0.0f, 0.0f, -1.0f, 0.0f) : glm::vec4(0.0f));
    }
    mFramebuffer.clearDepth(0.0f);
    mDraw.draw(world, state, mDepth);
}

void IrradianceBuffer::refreshRadii(const gl::Texture& surfaces) {
    const gl::DebugGroup group("irradiance radii");
    mRadii.use();
    surfaces.bind(0);
    mTargets[5].bindImage(0, 0, GL_WRITE_ONLY);
    mTargets[6].bindImage(1, 0, GL_WRITE_ONLY);
    mRadii.dispatchOver(mTargets[5].size2d());
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void IrradianceBuffer::buildMips() {
    const gl::DebugGroup group("irradiance mips");
    for (int level = 0; level < mLevels; ++level) {
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        mRangeMip.use();
        mRangeMip.set(0, level - 1);
        mTargets[0].bind(0);
        mDepthRanges.bind(1);
        mDepthRanges.bindImage(0, level, GL_WRITE_ONLY);
        mRangeMip.dispatchOver(mDepthRanges.size2d(level));
        if (level == 0) {
            continue;
        }
        mMip.use();
        mMip.set(0, level - 1);
        for (int i = 0; i < kTargets; ++i) {
            mTargets[i].bind(static_cast<GLuint>(i));
            mTargets[i].bindImage(static_cast<GLuint>(i), level, GL_WRITE_ONLY);
        }
        mMip.dispatchOver(mTargets[0].size2d(level));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
