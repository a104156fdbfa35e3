#include "renderer/splatting/tile_gather.h"

#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"

#include <algorithm>

namespace celadon {

namespace {

// tile_gather.comp
constexpr int kTilePx = 8;
constexpr int kSlices = 4;
constexpr int kBatch = 16;
constexpr int kBytesBesideProfiles = 9216; ///< stack, found nodes, samples at hand, sums
constexpr int kBytesPerKnot = 8;

constexpr int kMostRootsAcross = 8;
/// Software drivers end the loops of a shader after 65,535 rounds in all: where every texel may be
/// a sample, a dispatch has the 64 x 64 below a node of this level.
constexpr int kPartLevel = 6;

/// Levels until few roots are left, at least those of the buffer.
int treeLevels(const IrradianceBuffer& buffer) {
    int levels = buffer.levels();
    while ((buffer.paddedSize() - 1) >> (levels - 1) >= kMostRootsAcross) {
        ++levels;
    }
    return levels;
}

/// Of the finest profile that a pixel or a sample has.
int mostKnots(std::span<const MaterialPointer> maps, const GpuMaterials& materials) {
    int segments = materials.commonKnots().segments;
    for (const MaterialPointer& map : maps) {
        segments = std::max(segments, map->segments);
    }
    return segments + 1;
}

bool fitsSharedMemory(int knots, bool homogeneous) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &limit);
    const int profiles = homogeneous ? 1 : kTilePx * kTilePx + kBatch;
    return kBytesBesideProfiles + knots * profiles * kBytesPerKnot <= limit;
}

} // namespace

TileGather::TileGather(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> maps,
                       const GpuMaterials& materials, const SplattingBuffer& view,
                       const SplattingSettings& settings)
    : mExitance(gl::Texture::make2d("exitance", GL_RGBA32F, view.paddedSize(), view.levels())) {
    std::vector<gl::ShaderDefine> defines = schemeDefines(settings.scheme);
    mBuild = gl::Program("tree of samples", shaders, {"tile_tree.comp"}, defines);
    defines.push_back({"MATERIAL_COUNT", std::to_string(materials.count())});
    defines.push_back({"SLICES", std::to_string(kSlices)});
    defines.push_back({"BATCH", std::to_string(kBatch)});
    if (materials.isHomogeneous()) {
        defines.push_back({"HOMOGENEOUS", "1"});
    }
    const int knots = mostKnots(maps, materials);
    mKeepsProfiles = fitsSharedMemory(knots, materials.isHomogeneous());
    if (mKeepsProfiles) {
        defines.push_back({"KNOTS", std::to_string(knots)});
    }
    mGather = gl::Program("tile gather", shaders, {"tile_gather.comp"}, defines);
    const gl::Context* const context = gl::Context::current();
    mInParts =
        context != nullptr && context->isSoftware() &&
        !(settings.scheme == Scheme::Hierarchical && settings.adaptive && settings.multiresolution);
}

void TileGather::clear() {
    for (int k = 0; k < mExitance.levels(); ++k) {
        mExitance.clear(k, glm::vec4(0.0f));
    }
}

void TileGather::buildTree(const GpuSamples& samples) {
    const gl::DebugGroup group("tree of samples");
    const IrradianceBuffer& buffer = samples.buffer();
    if (!mTree) {
        const int levels = treeLevels(buffer);
        const glm::ivec2 size = paddedSize(glm::ivec2(buffer.paddedSize()), levels);
        mTree = gl::Texture::make2d("tree of samples", GL_RGBA32F, size, levels);
        if (samples.balls() == nullptr) {
            mFits = gl::Texture::make2d("fit nodes", GL_R32F, size, levels);
        }
    }
    mBuild.use();
    buffer.positions().bind(0);
    buffer.normals().bind(1);
    buffer.fluxes().bind(2);
    buffer.extents().bind(3);
    buffer.depthRanges().bind(4);
    mTree.bind(5);
    for (int level = 0; level < mTree.levels(); ++level) {
        mBuild.set(0, glm::ivec2(level, buffer.levels()));
        mTree.bindImage(0, level, GL_WRITE_ONLY);
        if (mFits) {
            mFits.bindImage(1, level, GL_WRITE_ONLY);
        }
        mBuild.dispatchOver(mTree.size2d(level));
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
}

void TileGather::gather(int splattingLevel, const SplattingBuffer& view, const GpuSamples& samples,
                        const GpuMaterials& materials) {
    const gl::DebugGroup group("tile gather");
    samples.bindNodes();
    materials.bindRangeTable(6);
    view.positions().bind(24);
    view.surfaces().bind(25);
    mTree.bind(26);
    if (mFits) {
        mFits.bind(28);
    }
    mExitance.bindImage(0, splattingLevel, GL_READ_WRITE);
    const int top = mTree.levels() - 1;
    const int rootLevel = mInParts ? std::min(kPartLevel, top) : top;
    const glm::ivec2 roots = mTree.size2d(rootLevel);
    const glm::ivec2 part = mInParts ? glm::ivec2(1) : roots;
    const glm::ivec2 tiles = (mExitance.size2d(splattingLevel) + kTilePx - 1) / kTilePx;
    mGather.use();
    mGather.set(0, glm::ivec4(splattingLevel, rootLevel, part));
    for (int y = 0; y < roots.y; y += part.y) {
        for (int x = 0; x < roots.x; x += part.x) {
            mGather.set(1, glm::ivec2(x, y));
            glDispatchCompute(static_cast<GLuint>(tiles.x), static_cast<GLuint>(tiles.y), 1);
            glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        }
    }
}

} // namespace celadon
