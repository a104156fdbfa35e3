#include "renderer/splatting/splatting_buffer.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"
#include "renderer/splatting/irradiance_buffer.h"

#include <algorithm>
#include <array>
#include <bit>

namespace celadon {

namespace {

constexpr int kGeometryTargets = 3; ///< of the targets, those with mips
constexpr int kTilePx = 8;          ///< as tile_range.comp has it

} // namespace

blocks::FrameBlock makeFrameBlock(const CameraView& view, glm::ivec2 size, glm::ivec2 paddedSize) {
    blocks::FrameBlock block;
    block.view = view.view;
    block.viewProjection = view.projection * view.view;
    block.eye = glm::vec4(glm::vec3(view.eye), view.orthographic ? 0.0f : 1.0f);
    block.forward = glm::vec4(glm::vec3(view.frame.forward), 0.0f);
    block.frameSize = glm::vec4(size, paddedSize);
    block.projection = glm::vec4(view.projection[0][0], view.projection[1][1],
                                 float(view.pixelWidth.scale), float(view.pixelWidth.offset));
    return block;
}

SplattingBuffer::SplattingBuffer(const gl::ShaderLibrary& shaders, int materialCount,
                                 glm::ivec2 size, int levels)
    : mSize(size),
      mLevels(levels),
      mPaddedSize(celadon::paddedSize(size, levels)),
      mBounds(0, 0, mPaddedSize),
      mFrameBlock("frame", sizeof(blocks::FrameBlock), gl::BufferUse::Update),
      mDraw("splatting buffer", shaders, SeenFrom::Camera, SurfaceDraw::Shows::Looks,
            "splatting_buffer.frag", {{"MATERIAL_COUNT", std::to_string(materialCount)}}),
      mRadii("surface radii", shaders, {"surface_radii.comp"},
             {{"MATERIAL_COUNT", std::to_string(materialCount)}}),
      mMip("median mip", shaders, {"median_mip.comp"}),
      mTileRange("tile range", shaders, {"tile_range.comp"}) {
    if (shaders.isDefined("VISIBLE_TRIANGLES")) {
        mTiles.emplace(mPaddedSize, levels);
    }
    mMipTiles.resize(static_cast<std::size_t>(levels));
    // Powers of two, so that every level is covered by the next.
    const glm::uvec2 tiles((mPaddedSize + kTilePx - 1) / kTilePx);
    const glm::ivec2 tileSize(std::bit_ceil(tiles.x), std::bit_ceil(tiles.y));
    mTileRanges = gl::Texture::make2d(
        "tile ranges", GL_RG32F, tileSize,
        std::bit_width(std::bit_floor(static_cast<unsigned>(std::min(tileSize.x, tileSize.y)))));
    const char* const names[kTargets] = {"positions", "normals",     "surface points",
                                         "lobes",     "base colors", "emission"};
    std::vector<gl::Attachment> colors;
    for (int i = 0; i < kTargets; ++i) {
        const bool geometry = i < kGeometryTargets;
        mTargets[i] = gl::Texture::make2d(std::string("splatting buffer: ") + names[i],
                                          geometry ? GL_RGBA32F : GL_RGBA16F, mPaddedSize,
                                          geometry ? levels : 1);
        colors.push_back({&mTargets[i]});
    }
    mDepth = gl::Texture::make2d("splatting buffer: depth", GL_DEPTH_COMPONENT32F, mPaddedSize);
    mFramebuffer = gl::Framebuffer("splatting buffer", colors, gl::Attachment{&mDepth});
}

const TriangleRaster* SplattingBuffer::draw(const GpuWorld& world, const CameraView& view,
                                            std::span<const glm::vec2> morePlaces) {
    const gl::DebugGroup group("splatting buffer");
    mFrameBlock.write(std::array{makeFrameBlock(view, mSize, mPaddedSize)});
    bind(world);
    gl::PassState state;
    state.framebuffer = &mFramebuffer;
    state.viewport = glm::ivec4(0, 0, mSize); // the padding stays background
    state.depthWrite = true;
    state.apply();
    // Whoever reads the others asks one of these first.
    mFramebuffer.clearColor(0, glm::vec4(0.0f));
    mFramebuffer.clearColor(2, glm::vec4(0.0f, 0.0f, -1.0f, 0.0f));
    mFramebuffer.clearDepth(0.0f);
    const TriangleRaster* const seen = mDraw.draw(world, state, mDepth, morePlaces);
    if (seen != nullptr) {
        mTiles->find(seen->triangles().first(seen->pixels()), mSize);
        mBounds = mTiles->bounds();
    }
    ++mDrawn;
    return seen;
}

void SplattingBuffer::bind(const GpuWorld& world) const {
    mFrameBlock.bindUniform(blocks::kFrame);
    world.bindBounds();
}

void SplattingBuffer::dispatchCovered(const gl::Program& program, int level) const {
    if (mTiles) {
        mTiles->dispatch(program, level);
    } else {
        program.dispatchOver(mTargets[0].size2d(level));
    }
}

void SplattingBuffer::dispatchTouched(const gl::Program& program, int level,
                                      TouchedTiles& touched) const {
    if (mTiles) {
        touched.dispatch(program, *mTiles, level);
    } else {
        program.dispatchOver(mTargets[0].size2d(level));
    }
}

void SplattingBuffer::refreshRadii() {
    const gl::DebugGroup group("surface radii");
    mRadii.use();
    const int built = mMipsOf == mDrawn ? mLevels : 1;
    for (int level = 0; level < built; ++level) {
        mTargets[2].bindImage(0, level, GL_READ_WRITE);
        dispatchCovered(mRadii, level);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SplattingBuffer::buildMips() {
    if (mMipsOf == mDrawn) {
        return;
    }
    mMipsOf = mDrawn;
    const gl::DebugGroup group("median mips");
    mMip.use();
    mMip.set(1, static_cast<float>(kClusterDepth));
    for (int level = 1; level < mLevels; ++level) {
        mMip.set(0, level - 1);
        for (int i = 0; i < kGeometryTargets; ++i) {
            mTargets[i].bind(static_cast<GLuint>(i));
            mTargets[i].bindImage(static_cast<GLuint>(i), level, GL_WRITE_ONLY);
        }
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        dispatchTouched(mMip, level, mMipTiles[static_cast<std::size_t>(level)]);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SplattingBuffer::buildTileRanges() {
    const gl::DebugGroup group("tile ranges");
    mTileRange.use();
    mTargets[0].bind(0);
    mTargets[2].bind(1);
    mTileRanges.bind(2);
    for (int level = 0; level < mTileRanges.levels(); ++level) {
        mTileRange.set(0, level - 1);
        mTileRanges.bindImage(0, level, GL_WRITE_ONLY);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        mTileRange.dispatchOver(mTileRanges.size2d(level));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

} // namespace celadon
