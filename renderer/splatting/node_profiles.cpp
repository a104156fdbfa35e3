#include "renderer/splatting/node_profiles.h"

#include "renderer/gl/debug.h"

#include <algorithm>

namespace celadon {

NodeProfiles::NodeProfiles(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer,
                           int materialCount, int segments)
    : mKnots(segments + 1),
      mProfiles(gl::Texture::makeArray("node profiles", GL_RGBA32F,
                                       glm::max(glm::ivec2(buffer.paddedSize() / 2), glm::ivec2(1)),
                                       segments + 1, std::max(1, buffer.levels() - 1))),
      mProfile("node profiles", shaders, {"node_profile.comp"},
               {{"MATERIAL_COUNT", std::to_string(materialCount)}}),
      mRadii("node radii", shaders, {"node_radii.comp"}) {}

void NodeProfiles::build(const IrradianceBuffer& buffer, float cutEnergy) {
    const gl::DebugGroup group("node profiles");
    for (int level = 1; level < buffer.levels(); ++level) {
        const glm::ivec2 size = mProfiles.size2d(level - 1);
        mProfile.use();
        mProfile.set(0, level - 1);
        buffer.fluxes().bind(0);
        buffer.surfaces().bind(1);
        mProfiles.bind(2);
        mProfiles.bindImage(0, level - 1, GL_WRITE_ONLY);
        mProfile.dispatchOver(size, mKnots);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        mRadii.use();
        mRadii.set(0, level);
        mRadii.set(1, cutEnergy);
        buffer.fluxes().bind(0);
        mProfiles.bind(1);
        buffer.extents().bindImage(0, level, GL_READ_WRITE);
        buffer.kepts().bindImage(1, level, GL_WRITE_ONLY);
        mRadii.dispatchOver(size);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
