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

void RasterSplat::splat(int splattingLevel, const SplattingBuffer& view,
                        const IrradianceBuffer& buffer, const NodeProfiles* profiles,
                        const NodeBalls* balls, const SampleSelection& selection,
                        const GpuMaterials& materials) {
    const gl::DebugGroup group("splats");
    gl::PassState state =
        gl::PassState::covering(mFramebuffers[static_cast<std::size_t>(splattingLevel)]);
    state.blend = gl::Blend::Additive;
    state.apply();
    // Units 0 to 5 are the sample's in the vertex shader, 24 to 26 the pixels'.
    buffer.positions().bind(0);
    buffer.fluxes().bind(1);
    buffer.surfaces().bind(2);
    buffer.covariances().bind(3);
    buffer.extents().bind(4);
    buffer.kepts().bind(5);
    materials.bindRangeTable(6);
    if (profiles != nullptr) {
        profiles->profiles().bind(7);
    }
    view.positions().bind(24);
    view.surfaces().bind(25);
    view.tileRanges().bind(26);
    if (balls != nullptr) {
        balls->radii().bind(27);
    }
    for (int level = 0; level < buffer.levels(); ++level) {
        const gl::Program& program = level > 0 && mNode ? *mNode : mLeaf;
        program.use();
        program.set(0, glm::ivec4(level, buffer.positions().size2d(level).x, splattingLevel, 0));
        selection.draw(level);
    }
}

} // namespace celadon
