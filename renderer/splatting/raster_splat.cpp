#include "renderer/splatting/raster_splat.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

namespace celadon {

RasterSplat::RasterSplat(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                         const SplattingBuffer& view, Scheme scheme)
    : mExitance(gl::Texture::make2d("exitance", GL_RGBA32F, view.paddedSize(), view.levels())) {
    for (int k = 0; k < view.levels(); ++k) {
        mFramebuffers.emplace_back("exitance", std::vector{gl::Attachment{&mExitance, k}});
    }
    std::vector<gl::ShaderDefine> defines = schemeDefines(scheme);
    defines.push_back({"MATERIAL_COUNT", std::to_string(materials.count())});
    if (materials.isHomogeneous()) {
        defines.push_back({"HOMOGENEOUS", "1"});
    } else {
        mNode =
            gl::Program("splat of a node", shaders,
                        {"raster_splat.vert", "raster_splat.geom", "raster_splat.frag"}, defines);
    }
    defines.push_back({"LEAF", "1"});
    mLeaf = gl::Program("splat of a leaf", shaders,
                        {"raster_splat.vert", "raster_splat.geom", "raster_splat.frag"}, defines);
}

void RasterSplat::clear() {
    for (int k = 0; k < mExitance.levels(); ++k) {
        mExitance.clear(k, glm::vec4(0.0f));
    }
}

void RasterSplat::splat(int splattingLevel, const SplattingBuffer& view, const GpuSamples& samples,
                        const GpuMaterials& materials) {
    const gl::DebugGroup group("splats");
    gl::PassState state =
        gl::PassState::covering(mFramebuffers[static_cast<std::size_t>(splattingLevel)]);
    state.blend = gl::Blend::Additive;
    state.apply();
    samples.bindNodes();
    materials.bindRangeTable(6);
    view.positions().bind(24);
    view.surfaces().bind(25);
    view.tileRanges().bind(26);
    const gl::Texture& positions = samples.buffer().positions();
    for (int level = 0; level < positions.levels(); ++level) {
        const gl::Program& program = level > 0 && mNode ? *mNode : mLeaf;
        program.use();
        program.set(0, glm::ivec4(level, positions.size2d(level).x, splattingLevel, 0));
        samples.selection().draw(level);
    }
}

} // namespace celadon
