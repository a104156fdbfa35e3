#include "renderer/gpu_world.h"

#include "renderer/gl/context.h"
#include "renderer/reference/cut_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace celadon {

namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec2 uv;
    glm::vec2 uv1;
};
static_assert(sizeof(Vertex) == GpuWorld::kVertexFloats * sizeof(float));

gl::Wrap toGl(Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        return gl::Wrap::Repeat;
    case Wrap::MirroredRepeat:
        return gl::Wrap::MirroredRepeat;
    case Wrap::ClampToEdge:
        return gl::Wrap::ClampToEdge;
    }
    return gl::Wrap::Repeat;
}

glm::vec4 toVec4(const BoundingSphere& sphere) {
    return glm::vec4(glm::vec3(sphere.center), float(sphere.radius));
}

/// Uniform locations of include/surface.glsl and splatting_buffer.frag.
enum Location {
    kMeshInfo = 0,
    kBaseColor,
    kLobe,
    kEmission,
    kTextureSets,
    kAlphaCutoff,
    kTextureTransforms
};
constexpr GLuint kColorAttribute = 4;

/// Ranges of storage buffers may begin at multiples of 256 bytes: a mesh begins at a multiple of so
/// many vertices and corners.
constexpr int kVertexUnit = 32;
constexpr int kCornerUnit = 64;
static_assert(kVertexUnit * sizeof(Vertex) % 256 == 0);
static_assert(kCornerUnit * sizeof(std::uint32_t) % 256 == 0);

int roundedUp(int count, int unit) {
    return (count + unit - 1) / unit * unit;
}

/// Texture units of include/visible_triangle.glsl.
enum TriangleUnit : GLuint { kVertexPairsUnit = 12, kCornerVerticesUnit, kVertexColorsUnit };

} // namespace

GpuWorld::GpuWorld(const World& world, Rasterizer rasterizer)
    : mWorld(world),
      mRasterizer(rasterizer),
      mBounds(
          gl::Buffer::of("bounds", std::array{blocks::BoundsBlock{toVec4(world.scatteringSphere),
                                                                  toVec4(world.sceneSphere)}})) {
    for (const SurfaceMaterial& look : world.looks) {
        addLook(world, look);
    }
    placeMeshes();
    if (mRasterizer == Rasterizer::Auto) {
        mRasterizer = canBeRasterized() ? Rasterizer::Processor : Rasterizer::Driver;
    }
    fillBuffers();
    if (mRasterizer == Rasterizer::Processor) {
        mRaster = std::make_unique<TriangleRaster>();
    }
}

blocks::BoundsBlock GpuWorld::readBounds() const {
    return mBounds.read<blocks::BoundsBlock>().front();
}

int GpuWorld::addImage(const World& world, int image, bool srgb) {
    const std::pair<int, bool> key(image, srgb);
    const auto found = std::find(mImageKeys.begin(), mImageKeys.end(), key);
    if (found != mImageKeys.end()) {
        return static_cast<int>(found - mImageKeys.begin());
    }
    const Image& source = world.images[static_cast<std::size_t>(image)];
    const glm::ivec2 size(source.width, source.height);
    gl::Texture texture = gl::Texture::make2d(source.name, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, size,
                                              gl::fullLevelCount(size));
    texture.upload(0, source.rgba);
    texture.generateMipmaps();
    mImages.push_back(std::move(texture));
    mImageKeys.push_back(key);
    return static_cast<int>(mImages.size()) - 1;
}

GpuWorld::LookTexture GpuWorld::addTexture(const World& world, const TextureReference& reference,
                                           bool srgb) {
    LookTexture texture;
    if (!reference.isSet()) {
        return texture;
    }
    texture.image = addImage(world, reference.image, srgb);
    texture.uvSet = reference.uvSet;
    texture.transform = reference.transform;
    texture.sampler = gl::Sampler(
        "look", reference.nearest ? gl::Filter::NearestMipmap : gl::Filter::LinearMipmap,
        toGl(reference.wrapU), toGl(reference.wrapV));
    return texture;
}

void GpuWorld::addLook(const World& world, const SurfaceMaterial& material) {
    Look look;
    look.baseColor = material.baseColor;
    look.lobe = glm::vec4(material.metallic, material.roughness, material.ior.value_or(0.0f),
                          material.normalScale);
    look.emission = material.emission;
    look.alphaCutoff = material.alphaCutoff.value_or(-1.0f);
    look.doubleSided = material.doubleSided;
    look.textures[0] = addTexture(world, material.baseColorTexture, true);
    look.textures[1] = addTexture(world, material.metallicRoughnessTexture, false);
    look.textures[2] = addTexture(world, material.normalTexture, false);
    look.textures[3] = addTexture(world, material.emissiveTexture, true);
    mLooks.push_back(std::move(look));
}

void GpuWorld::placeMeshes() {
    GpuMesh next;
    for (const WorldMesh& source : mWorld.meshes) {
        next.vertexCount = static_cast<int>(source.mesh.positions.size());
        next.triangleCount = static_cast<int>(source.mesh.triangleCount());
        next.look = source.mesh.material;
        next.scattering = source.scattering;
        mMeshes.push_back(next);
        next.firstVertex += roundedUp(next.vertexCount, kVertexUnit);
        next.firstTriangle += next.triangleCount;
        next.firstCorner += roundedUp(3 * next.triangleCount, kCornerUnit);
    }
}

bool GpuWorld::canBeRasterized() const {
    const gl::Context* const context = gl::Context::current();
    if (context == nullptr || !context->isSoftware() || mMeshes.empty()) {
        return false;
    }
    const GLint64 most = gl::BufferTexture::greatestSize();
    const GpuMesh& last = mMeshes.back();
    return (GLint64{last.firstVertex} + last.vertexCount + 1) * kVertexFloats / 2 <= most &&
           GLint64{last.firstCorner} + 3 * GLint64{last.triangleCount} + 3 <= most;
}

void GpuWorld::fillBuffers() {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec4> colors;
    std::vector<glm::ivec4> places;
    const bool hasColors = std::ranges::any_of(
        mWorld.meshes, [](const WorldMesh& mesh) { return !mesh.mesh.colors.empty(); });
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        const Mesh& mesh = mWorld.meshes[m].mesh;
        vertices.resize(static_cast<std::size_t>(mMeshes[m].firstVertex));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[i];
            vertices.push_back(
                {mesh.positions[i], mesh.normals[i], uv, mesh.uvs1.empty() ? uv : mesh.uvs1[i]});
        }
        indices.resize(static_cast<std::size_t>(mMeshes[m].firstCorner));
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        if (hasColors) {
            colors.resize(static_cast<std::size_t>(mMeshes[m].firstVertex), glm::vec4(1.0f));
            colors.insert(colors.end(), mesh.colors.begin(), mesh.colors.end());
            colors.resize(vertices.size(), glm::vec4(1.0f));
        }
        places.push_back(placeOf(m));
    }
    vertices.emplace_back(); // so that the range of an empty mesh, rounded up, is one
    indices.resize(indices.size() + 3);
    const gl::BufferUse use =
        mRasterizer == Rasterizer::Processor ? gl::BufferUse::Readback : gl::BufferUse::Device;
    mVertices = gl::Buffer::of("vertices", vertices, use);
    mIndices = gl::Buffer::of("indices", indices, use);
    mPlaces = gl::Buffer::of("places of meshes", places);
    mVertexArray = gl::VertexArray("surface");
    mVertexArray.setBuffer(0, mVertices, sizeof(Vertex));
    mVertexArray.setAttribute(0, {.location = 0, .components = 3, .offsetBytes = 0});
    mVertexArray.setAttribute(0, {.location = 1, .components = 3, .offsetBytes = 12});
    mVertexArray.setAttribute(0, {.location = 2, .components = 2, .offsetBytes = 24});
    mVertexArray.setAttribute(0, {.location = 3, .components = 2, .offsetBytes = 32});
    if (hasColors) {
        mColors = gl::Buffer::of("vertex colors", colors);
        mVertexArray.setBuffer(1, mColors, sizeof(glm::vec4));
        mVertexArray.setAttribute(1,
                                  {.location = kColorAttribute, .components = 4, .offsetBytes = 0});
    }
    mVertexArray.setIndexBuffer(mIndices);
    if (mRasterizer == Rasterizer::Processor) {
        mVertexPairs = gl::BufferTexture("vertices", GL_RG32F, mVertices);
        mCornerVertices = gl::BufferTexture("indices", GL_R32UI, mIndices);
        if (hasColors) {
            mVertexColors = gl::BufferTexture("vertex colors", GL_RGBA32F, mColors);
        }
    }
}

void GpuWorld::setBase(const gl::Program& program, const Look& look, int textures) const {
    program.set(kBaseColor, look.baseColor);
    glm::ivec4 sets(-1);
    for (int i = 0; i < textures; ++i) {
        const LookTexture& texture = look.textures[i];
        sets[i] = texture.uvSet;
        program.set(kTextureTransforms + i, texture.transform);
        if (texture.image >= 0) {
            mImages[static_cast<std::size_t>(texture.image)].bind(static_cast<GLuint>(i));
            texture.sampler.bind(static_cast<GLuint>(i));
        }
    }
    program.set(kTextureSets, sets);
}

void GpuWorld::setMesh(const gl::Program& program, std::size_t index, bool looks) const {
    const GpuMesh& mesh = mMeshes[index];
    const Look& look = mLooks[static_cast<std::size_t>(mesh.look)];
    program.set(kMeshInfo, glm::ivec4(mesh.scattering, look.doubleSided ? 1 : 0,
                                      static_cast<int>(index) + 1, 0));
    program.set(kAlphaCutoff, look.alphaCutoff);
    if (looks) {
        setBase(program, look, kLookTextures);
        program.set(kLobe, look.lobe);
        program.set(kEmission, look.emission);
    } else if (look.alphaCutoff >= 0.0f) {
        setBase(program, look, 1);
    }
}

void GpuWorld::unbindLooks() {
    for (GLuint unit = 0; unit < kLookTextures; ++unit) {
        gl::Sampler::unbind(unit);
    }
}

void GpuWorld::draw(const gl::Program& program, bool looks) const {
    program.use();
    mVertexArray.bind();
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        const GpuMesh& mesh = mMeshes[m];
        setMesh(program, m, looks);
        const auto offset = static_cast<std::uintptr_t>(mesh.firstCorner) * sizeof(std::uint32_t);
        glDrawElementsBaseVertex(GL_TRIANGLES, 3 * mesh.triangleCount, GL_UNSIGNED_INT,
                                 reinterpret_cast<const void*>(offset), mesh.firstVertex);
    }
    unbindLooks();
}

const TriangleRaster& GpuWorld::rasterize(const RasterView& view) const {
    glFinish(); // so that the buffers hold what moved the vertices
    const auto* const vertices = reinterpret_cast<const float*>(mVertices.mapped().data());
    const auto* const indices = reinterpret_cast<const std::uint32_t*>(mIndices.mapped().data());
    std::vector<RasterMesh> meshes;
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        const GpuMesh& source = mMeshes[m];
        RasterMesh mesh;
        mesh.vertices = vertices + static_cast<std::size_t>(source.firstVertex) * kVertexFloats;
        mesh.vertexFloats = kVertexFloats;
        mesh.vertexCount = static_cast<std::size_t>(source.vertexCount);
        mesh.corners = {indices + source.firstCorner,
                        3 * static_cast<std::size_t>(source.triangleCount)};
        if (mayBeCutOut(mWorld, mWorld.meshes[m].mesh)) {
            mesh.isHole = [this, m, corners = mesh.corners](std::uint32_t triangle, double u,
                                                            double v) {
                const std::size_t second = 3 * std::size_t{triangle} + 1;
                if (corners[second] != mWorld.meshes[m].mesh.indices[second]) {
                    std::swap(u, v); // a pose that mirrors the mesh turned it over
                }
                return isCutOut(mWorld, {static_cast<int>(m), triangle, u, v});
            };
        }
        meshes.push_back(std::move(mesh));
    }
    mRaster->draw(meshes, view);
    return *mRaster;
}

void GpuWorld::bindTriangles() const {
    mVertexPairs.bind(kVertexPairsUnit);
    mCornerVertices.bind(kCornerVerticesUnit);
    mVertexColors.bind(kVertexColorsUnit);
}

glm::ivec4 GpuWorld::placeOf(std::size_t index) const {
    const GpuMesh& mesh = mMeshes[index];
    return {mesh.firstTriangle, mesh.firstVertex, mesh.firstCorner,
            mesh.firstTriangle + mesh.triangleCount};
}

GpuWorld::Geometry GpuWorld::geometry(std::size_t index) const {
    const GpuMesh& mesh = mMeshes[index];
    return {mVertices,        mIndices,           mesh.firstVertex,    mesh.vertexCount,
            mesh.firstCorner, mesh.triangleCount, mesh.scattering >= 0};
}

void GpuWorld::Geometry::bindVertices(GLuint storageBinding) const {
    vertexBuffer.bindStorage(storageBinding, static_cast<std::size_t>(firstVertex) * sizeof(Vertex),
                             static_cast<std::size_t>(std::max(vertexCount, 1)) * sizeof(Vertex));
}

void GpuWorld::Geometry::bindIndices(GLuint storageBinding) const {
    constexpr std::size_t kBytes = sizeof(std::uint32_t);
    indexBuffer.bindStorage(storageBinding, static_cast<std::size_t>(firstCorner) * kBytes,
                            3 * static_cast<std::size_t>(std::max(triangleCount, 1)) * kBytes);
}

std::vector<float> GpuWorld::Geometry::readVertices() const {
    return vertexBuffer.read<float>(static_cast<std::size_t>(firstVertex) * kVertexFloats,
                                    static_cast<std::size_t>(vertexCount) * kVertexFloats);
}

std::vector<std::uint32_t> GpuWorld::Geometry::readIndices() const {
    return indexBuffer.read<std::uint32_t>(static_cast<std::size_t>(firstCorner),
                                           3 * static_cast<std::size_t>(triangleCount));
}

namespace {

/// Of which textures some look has one, as a constant of the shading language.
std::string lookTextures(const World& world) {
    const auto any = [&](TextureReference SurfaceMaterial::*texture) {
        return std::ranges::any_of(
            world.looks, [&](const SurfaceMaterial& look) { return (look.*texture).image >= 0; });
    };
    return fmt::format("bvec4({}, {}, {}, {})", any(&SurfaceMaterial::baseColorTexture),
                       any(&SurfaceMaterial::metallicRoughnessTexture),
                       any(&SurfaceMaterial::normalTexture),
                       any(&SurfaceMaterial::emissiveTexture));
}

} // namespace

std::vector<gl::ShaderDefine> sceneDefines(const World& world, Rasterizer rasterizer) {
    std::vector<gl::ShaderDefine> defines;
    if (std::any_of(world.looks.begin(), world.looks.end(),
                    [](const SurfaceMaterial& look) { return look.alphaCutoff.has_value(); })) {
        defines.push_back({"CUT_OUT", "1"});
    }
    if (std::any_of(world.meshes.begin(), world.meshes.end(),
                    [](const WorldMesh& mesh) { return !mesh.mesh.colors.empty(); })) {
        defines.push_back({"VERTEX_COLORS", "1"});
    }
    if (rasterizer == Rasterizer::Processor) {
        defines.push_back({"VISIBLE_TRIANGLES", "1"});
    }
    defines.push_back({"LOOK_TEXTURES", lookTextures(world)});
    return defines;
}

} // namespace celadon
