#include "renderer/gpu_materials.h"

#include "renderer/gpu_blocks.h"
#include "renderer/shading/fresnel.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// Texture units of material.glsl.
enum Unit : GLuint { kTables = 8, kFarEnergy = 9 };

constexpr GLenum kTablesFormat = GL_RGBA32F;
constexpr GLenum kFarEnergyFormat = GL_RGBA16F;
constexpr float kLog2TMax = 12.0f;
constexpr int kBorder = 1;      ///< texels around a map, so that filtering finds its other side
constexpr int kExtraLayers = 3; ///< beyond the knots: radii, kept energy, specular lobe

/// [height][width][knot][3], rows `rowStride` apart -> [knot][height][width][4]
std::vector<float> asSlices(const float* first, std::size_t rowStride, glm::ivec2 size, int knots) {
    constexpr int kAtOnce = 64; // texels that stay in the cache while their knots are spread
    const auto values = static_cast<std::size_t>(knots) * 3;
    const auto width = static_cast<std::size_t>(size.x);
    const std::size_t texels = width * static_cast<std::size_t>(size.y);
    std::vector<float> slices(texels * static_cast<std::size_t>(knots) * 4);
    tbb::parallel_for(0, size.y, [&](int y) {
        const float* const row = first + static_cast<std::size_t>(y) * rowStride;
        for (std::size_t begin = 0; begin < width; begin += kAtOnce) {
            const std::size_t end = std::min(begin + kAtOnce, width);
            for (std::size_t k = 0; k < static_cast<std::size_t>(knots); ++k) {
                float* to = &slices[(k * texels + static_cast<std::size_t>(y) * width + begin) * 4];
                for (std::size_t x = begin; x < end; ++x, to += 4) {
                    std::copy_n(row + x * values + k * 3, 3, to);
                }
            }
        }
    });
    return slices;
}

/// [height][width][4] of a rectangle: roughness and specular, -1 where the map has none.
std::vector<float> lobeSlice(const subedit::MaterialMap& map, const subedit::TexelRect& rect) {
    std::vector<float> slice(rect.texels() * 4, -1.0f);
    std::size_t t = 0;
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x, t += 4) {
            const std::size_t texel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(x);
            slice[t] = map.roughness.empty() ? -1.0f : map.roughness[texel];
            slice[t + 1] = map.specular.empty() ? -1.0f : map.specular[texel];
        }
    }
    return slice;
}

/// @param sizes width, height and knots of each
MaterialSlots slotsOf(std::span<const glm::ivec3> sizes) {
    std::vector<glm::ivec3> slots;
    for (const glm::ivec3& size : sizes) {
        slots.push_back(size + glm::ivec3(2 * kBorder, 2 * kBorder, kExtraLayers));
    }
    return arrangeMaterials(slots);
}

void checkSize(std::span<const MaterialPointer> materials, const glm::ivec3& extent) {
    GLint side = 0;
    GLint layers = 0;
    GLint blockBytes = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    glGetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &blockBytes);
    const std::size_t entries =
        static_cast<std::size_t>(blockBytes) / sizeof(blocks::MaterialEntry);
    if (materials.size() > entries) {
        throw InputError("the scene",
                         fmt::format("{} SubEdit materials are more than the {} that this driver's "
                                     "uniform blocks hold",
                                     materials.size(), entries),
                         "let meshes share a material, as one map over their common atlas");
    }
    if (extent.x > side || extent.y > side || extent.z > layers) {
        throw InputError(
            materials.size() == 1 ? "material '" + materials[0]->name + "'"
                                  : fmt::format("the scene's {} materials", materials.size()),
            fmt::format("{}x{} texels of {} layers are more than this driver's {}x{}x{}", extent.x,
                        extent.y, extent.z, side, side, layers),
            "make them smaller with 'celadon material convert'");
    }
}

/// The whole map in parts whose tables take no more memory than a few maps of usual size.
std::vector<subedit::TexelRect> bandsOf(const subedit::MaterialMap& map) {
    constexpr int kBandTexels = 1 << 15;
    const int rows = std::max(kBandTexels / map.width, 1);
    std::vector<subedit::TexelRect> bands;
    for (int y = 0; y < map.height; y += rows) {
        bands.push_back({0, y, map.width, std::min(rows, map.height - y)});
    }
    return bands;
}

/// Copies what lies at the map's rim to the border on the other side.
/// @param corner of the map's texel (0, 0) in the array
void repeatAtBorder(const gl::Texture& texture, const glm::ivec3& corner, glm::ivec2 size,
                    int layers, const subedit::TexelRect& rect) {
    for (int v = -1; v <= 1; ++v) {
        for (int u = -1; u <= 1; ++u) {
            const glm::ivec2 shift = glm::ivec2(u, v) * size;
            const glm::ivec2 low =
                glm::max(glm::ivec2(rect.x, rect.y) + shift, glm::ivec2(-kBorder));
            const glm::ivec2 high =
                glm::min(glm::ivec2(rect.right(), rect.bottom()) + shift, size + kBorder);
            if ((u == 0 && v == 0) || low.x >= high.x || low.y >= high.y) {
                continue;
            }
            const glm::ivec3 to = corner + glm::ivec3(low, 0);
            const glm::ivec3 from = to - glm::ivec3(shift, 0);
            glCopyImageSubData(texture.id(), texture.target(), 0, from.x, from.y, from.z,
                               texture.id(), texture.target(), 0, to.x, to.y, to.z, high.x - low.x,
                               high.y - low.y, layers);
        }
    }
}

} // namespace

GpuMaterials::GpuMaterials(std::span<const MaterialPointer> materials, double energy,
                           double epsilon, ExitFresnel exitFresnel, const MakingProgress& tell,
                           std::span<const float> rangeTable)
    : mSlots(slotsOf(sizesOf(materials))),
      mHeldFarEnergies(materials),
      mMapSampler("material map", gl::Filter::Linear),
      mTableSampler("range table", gl::Filter::Linear),
      mEnergy(energy) {
    checkSize(materials, mSlots.extent);
    mTables = gl::Texture::makeArray("materials", kTablesFormat, glm::ivec2(mSlots.extent),
                                     mSlots.extent.z);
    mFarEnergy = gl::Texture::makeArray("far energy of materials", kFarEnergyFormat,
                                        glm::ivec2(mSlots.extent), mSlots.extent.z);
    const glm::vec2 texel = 1.0f / glm::vec2(mSlots.extent);
    std::vector<blocks::MaterialEntry> entries;
    std::vector<float> tables;
    std::size_t texels = 0;
    std::size_t done = 0;
    for (const MaterialPointer& material : materials) {
        texels +=
            static_cast<std::size_t>(material->width) * static_cast<std::size_t>(material->height);
    }
    for (const MaterialPointer& material : materials) {
        const subedit::MaterialMap& map = *material;
        MaterialTables made = makeMaterialTables(map, epsilon);
        if (!rangeTable.empty()) {
            made.rangeTable.assign(rangeTable.begin(), rangeTable.end());
        }
        const std::size_t index = entries.size();
        mMeanLogProfiles.push_back(std::move(made.meanLogProfile));
        for (const subedit::TexelRect& rows : bandsOf(map)) {
            if (tell) {
                tell(static_cast<float>(done) / static_cast<float>(texels));
            }
            update(static_cast<int>(index), map, rows);
            done += rows.texels();
        }

        const double c = exitFresnel == ExitFresnel::Exact
                             ? diffuseTransmittance(static_cast<double>(map.eta))
                             : 1.0;
        blocks::MaterialEntry entry;
        entry.profile = glm::vec4(map.maxRadiusMm, float(map.segments), map.eta, float(1.0 / c));
        const glm::ivec3& origin = mSlots.origins[index];
        entry.place = glm::vec4((glm::vec2(origin) + float(kBorder)) * texel,
                                glm::vec2(map.width, map.height) * texel);
        entry.layers = glm::vec4(float(origin.z), 0.0f, 0.0f, 0.0f);
        entries.push_back(entry);
        mTableSize = made.rangeTable.size();
        tables.insert(tables.end(), made.rangeTable.begin(), made.rangeTable.end());
        mShortRadiusMm = std::min(mShortRadiusMm, made.shortRadiusMm);
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

bool GpuMaterials::hasRoom(std::span<const glm::ivec3> sizes) {
    const glm::ivec3 extent = slotsOf(sizes).extent;
    return gl::Texture::canMakeArray(kTablesFormat, glm::ivec2(extent), extent.z) &&
           gl::Texture::canMakeArray(kFarEnergyFormat, glm::ivec2(extent), extent.z);
}

void GpuMaterials::update(int material, const subedit::MaterialMap& map,
                          const subedit::TexelRect& rect) {
    const TexelTables tables =
        makeTexelTables(map, rect, mEnergy, mMeanLogProfiles[static_cast<std::size_t>(material)]);
    const glm::ivec3 corner = cornerOf(material);
    const glm::ivec3 offset = corner + glm::ivec3(rect.x, rect.y, 0);
    const glm::ivec2 size(rect.width, rect.height);
    const int knots = map.knots();
    const auto values = static_cast<std::size_t>(knots) * 3;
    const auto slicesOf = [&](const float* first, int width) {
        return asSlices(first, values * static_cast<std::size_t>(width), size, knots);
    };
    mTables.uploadRegion(0, offset, glm::ivec3(size, knots),
                         slicesOf(map.logProfile.data() + map.index(rect.x, rect.y, 0), map.width));
    mTables.uploadRegion(0, offset + glm::ivec3(0, 0, knots), glm::ivec3(size, 1), tables.radii);
    mTables.uploadRegion(0, offset + glm::ivec3(0, 0, knots + 1), glm::ivec3(size, 1), tables.kept);
    mTables.uploadRegion(0, offset + glm::ivec3(0, 0, knots + 2), glm::ivec3(size, 1),
                         lobeSlice(map, rect));
    mFarEnergy.uploadRegion(0, offset, glm::ivec3(size, knots),
                            slicesOf(tables.logFarEnergy.data(), rect.width));
    const glm::ivec2 mapSize(map.width, map.height);
    repeatAtBorder(mTables, corner, mapSize, knots + kExtraLayers, rect);
    repeatAtBorder(mFarEnergy, corner, mapSize, knots, rect);
    mHeldFarEnergies.changed(material, rect);
}

glm::ivec3 GpuMaterials::cornerOf(int material) const {
    return mSlots.origins[static_cast<std::size_t>(material)] + glm::ivec3(kBorder, kBorder, 0);
}

FarEnergies::Selection GpuMaterials::selectFarEnergies(std::span<const float> radiiMm) const {
    return mHeldFarEnergies.select(radiiMm, [this](int material, int knot,
                                                   const subedit::TexelRect& rect,
                                                   std::span<std::uint16_t> halves) {
        mFarEnergy.readRegion(0, cornerOf(material) + glm::ivec3(rect.x, rect.y, knot),
                              glm::ivec3(rect.width, rect.height, 1), halves);
    });
}

void GpuMaterials::bind() const {
    mBlock.bindUniform(blocks::kMaterials);
    mTables.bind(kTables);
    mFarEnergy.bind(kFarEnergy);
    mMapSampler.bind(kTables);
    mMapSampler.bind(kFarEnergy);
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
