#include "renderer/gpu_materials.h"

#include "renderer/gpu_blocks.h"
#include "renderer/material_tables.h"
#include "renderer/shading/fresnel.h"
#include "subedit/errors.h"

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// First texture units of the arrays in material.glsl.
enum Unit : GLuint { kLogProfiles = 8, kRadii = 12, kKept = 16, kFarEnergy = 20 };

constexpr float kLog2TMax = 12.0f;

/// [height][width][knot][3] of a rectangle -> [knot][height][width][4]
std::vector<float> knotsAsSlices(const subedit::MaterialMap& map, const subedit::TexelRect& rect) {
    const std::size_t knots = static_cast<std::size_t>(map.knots());
    const std::size_t texels = rect.texels();
    std::vector<float> slices(texels * knots * 4, 0.0f);
    std::size_t t = 0;
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x, ++t) {
            const float* const profile = map.logProfile.data() + map.index(x, y, 0);
            for (std::size_t k = 0; k < knots; ++k) {
                std::copy_n(profile + k * 3, 3, &slices[(k * texels + t) * 4]);
            }
        }
    }
    return slices;
}

void checkSize(const subedit::MaterialMap& map) {
    GLint limit2d = 0;
    GLint limit3d = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit2d);
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limit3d);
    const int limit = std::min(limit2d, limit3d);
    if (map.width > limit || map.height > limit) {
        throw InputError("material '" + map.name + "'",
                         std::to_string(map.width) + "x" + std::to_string(map.height) +
                             " texels are more than this driver's " + std::to_string(limit),
                         "resize it with 'celadon material convert'");
    }
}

} // namespace

GpuMaterials::GpuMaterials(std::span<const MaterialPointer> materials, double energy,
                           double epsilon, ExitFresnel exitFresnel,
                           std::span<const float> rangeTable)
    : mMapSampler("material map", gl::Filter::Linear, gl::Wrap::Repeat),
      mTableSampler("range table", gl::Filter::Linear),
      mEnergy(energy) {
    if (materials.size() > static_cast<std::size_t>(kMaxMaterials)) {
        throw InputError("the scene",
                         std::to_string(materials.size()) +
                             " SubEdit materials are more than the " +
                             std::to_string(kMaxMaterials) + " that one scene can have",
                         "let meshes share a material, as one map over their common atlas");
    }
    std::vector<blocks::MaterialEntry> entries;
    std::vector<float> tables;
    for (const MaterialPointer& material : materials) {
        const subedit::MaterialMap& map = *material;
        checkSize(map);
        MaterialTables made = makeMaterialTables(map, energy, epsilon);
        if (!rangeTable.empty()) {
            made.rangeTable.assign(rangeTable.begin(), rangeTable.end());
        }
        const glm::ivec2 size(map.width, map.height);
        const glm::ivec3 boxSize(size, map.knots());
        gl::Texture logProfile = gl::Texture::make3d("ln P of " + map.name, GL_RGBA32F, boxSize);
        logProfile.upload(0, knotsAsSlices(map, {0, 0, map.width, map.height}));
        gl::Texture radii = gl::Texture::make2d("radii of " + map.name, GL_RGBA32F, size);
        radii.upload(0, made.texels.radii);
        gl::Texture kept = gl::Texture::make2d("kept energy of " + map.name, GL_RGBA32F, size);
        kept.upload(0, made.texels.kept);
        gl::Texture far = gl::Texture::make3d("far energy of " + map.name, GL_RGBA16F, boxSize);
        far.upload(0, made.texels.logFarEnergy);
        mMeanLogProfiles.push_back(made.meanLogProfile);
        mLogProfiles.push_back(std::move(logProfile));
        mRadii.push_back(std::move(radii));
        mKept.push_back(std::move(kept));
        mFarEnergy.push_back(std::move(far));

        const double c = exitFresnel == ExitFresnel::Exact
                             ? diffuseTransmittance(static_cast<double>(map.eta))
                             : 1.0;
        blocks::MaterialEntry entry;
        entry.profile = glm::vec4(map.maxRadiusMm, float(map.segments), map.eta, float(1.0 / c));
        entry.look = glm::vec4(0.0f);
        entries.push_back(entry);
        mTableSize = made.rangeTable.size();
        tables.insert(tables.end(), made.rangeTable.begin(), made.rangeTable.end());
        mMeanRadiusMm += made.meanRadiusMm / static_cast<float>(materials.size());
    }
    mRangeTable = gl::Texture::make2d(
        "range table", GL_R32F,
        glm::ivec2(static_cast<int>(mTableSize), static_cast<int>(materials.size())));
    mRangeTable.upload(0, tables);
    mRangeTables = std::move(tables);
    mBlock = gl::Buffer::of("materials", entries);
    mCommonKnots = celadon::commonKnots(materials);
    mHomogeneous = materials.size() == 1 && materials[0]->isHomogeneous();
}

void GpuMaterials::update(int material, const subedit::MaterialMap& map,
                          const subedit::TexelRect& rect) {
    const auto index = static_cast<std::size_t>(material);
    const glm::ivec3 offset(rect.x, rect.y, 0);
    const glm::ivec3 extent(rect.width, rect.height, 1);
    const glm::ivec3 box(rect.width, rect.height, map.knots());
    const TexelTables made = makeTexelTables(map, rect, mEnergy, mMeanLogProfiles[index]);
    mLogProfiles[index].uploadRegion(0, offset, box, knotsAsSlices(map, rect));
    mRadii[index].uploadRegion(0, offset, extent, made.radii);
    mKept[index].uploadRegion(0, offset, extent, made.kept);
    mFarEnergy[index].uploadRegion(0, offset, box, made.logFarEnergy);
}

void GpuMaterials::bind() const {
    mBlock.bindUniform(blocks::kMaterials);
    const auto bindAll = [&](const std::vector<gl::Texture>& textures, GLuint unit) {
        for (const gl::Texture& texture : textures) {
            texture.bind(unit);
            mMapSampler.bind(unit);
            ++unit;
        }
    };
    bindAll(mLogProfiles, kLogProfiles);
    bindAll(mRadii, kRadii);
    bindAll(mKept, kKept);
    bindAll(mFarEnergy, kFarEnergy);
}

void GpuMaterials::bindRangeTable(GLuint unit) const {
    mRangeTable.bind(unit);
    mTableSampler.bind(unit);
}

float GpuMaterials::minimalRadius(float pixelsPerRadius, int material) const {
    const float position =
        std::clamp(std::log2(std::max(pixelsPerRadius, 1.0f)) / kLog2TMax, 0.0f, 1.0f) *
        static_cast<float>(mTableSize - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(position), mTableSize - 2);
    const float t = position - static_cast<float>(i);
    const float* table = mRangeTables.data() + static_cast<std::size_t>(material) * mTableSize;
    return table[i] + t * (table[i + 1] - table[i]);
}

} // namespace celadon
