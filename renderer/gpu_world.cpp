#include "renderer/gpu_world.h"

#include "renderer/gl/debug.h"

#include <algorithm>
#include <array>

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

} // namespace

GpuWorld::GpuWorld(const World& world)
    : mBounds(
          gl::Buffer::of("bounds", std::array{blocks::BoundsBlock{toVec4(world.scatteringSphere),
                                                                  toVec4(world.sceneSphere)}})) {
    for (const SurfaceMaterial& look : world.looks) {
        addLook(world, look);
    }
    for (const WorldMesh& mesh : world.meshes) {
        addMesh(mesh);
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

void GpuWorld::addMesh(const WorldMesh& source) {
    const Mesh& mesh = source.mesh;
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[i];
        vertices[i] = {mesh.positions[i], mesh.normals[i], uv,
                       mesh.uvs1.empty() ? uv : mesh.uvs1[i]};
    }
    GpuMesh result;
    result.vertices = gl::Buffer::of("vertices of " + mesh.name, vertices);
    result.indices = gl::Buffer::of("indices of " + mesh.name, mesh.indices);
    result.vertexArray = gl::VertexArray(mesh.name);
    result.vertexArray.setBuffer(0, result.vertices, sizeof(Vertex));
    result.vertexArray.setAttribute(0, {.location = 0, .components = 3, .offsetBytes = 0});
    result.vertexArray.setAttribute(0, {.location = 1, .components = 3, .offsetBytes = 12});
    result.vertexArray.setAttribute(0, {.location = 2, .components = 2, .offsetBytes = 24});
    result.vertexArray.setAttribute(0, {.location = 3, .components = 2, .offsetBytes = 32});
    if (!mesh.colors.empty()) {
        result.colors = gl::Buffer::of("colors of " + mesh.name, mesh.colors);
        result.vertexArray.setBuffer(1, result.colors, sizeof(glm::vec4));
        result.vertexArray.setAttribute(
            1, {.location = kColorAttribute, .components = 4, .offsetBytes = 0});
    }
    result.vertexArray.setIndexBuffer(result.indices);
    result.indexCount = static_cast<int>(mesh.indices.size());
    result.look = mesh.material;
    result.scattering = source.scattering;
    mMeshes.push_back(std::move(result));
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

void GpuWorld::draw(const gl::Program& program, bool looks) const {
    program.use();
    glVertexAttrib4f(kColorAttribute, 1.0f, 1.0f, 1.0f, 1.0f); // of meshes without colors
    int meshId = 0;
    for (const GpuMesh& mesh : mMeshes) {
        const Look& look = mLooks[static_cast<std::size_t>(mesh.look)];
        program.set(kMeshInfo, glm::ivec4(mesh.scattering, look.doubleSided ? 1 : 0, ++meshId, 0));
        program.set(kAlphaCutoff, look.alphaCutoff);
        if (looks) {
            setBase(program, look, kLookTextures);
            program.set(kLobe, look.lobe);
            program.set(kEmission, look.emission);
        } else if (look.alphaCutoff >= 0.0f) {
            setBase(program, look, 1);
        }
        mesh.vertexArray.bind();
        glDrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
    }
    for (GLuint unit = 0; unit < kLookTextures; ++unit) {
        gl::Sampler::unbind(unit);
    }
}

std::vector<gl::ShaderDefine> sceneDefines(const World& world) {
    std::vector<gl::ShaderDefine> defines;
    if (std::any_of(world.looks.begin(), world.looks.end(),
                    [](const SurfaceMaterial& look) { return look.alphaCutoff.has_value(); })) {
        defines.push_back({"CUT_OUT", "1"});
    }
    if (std::any_of(world.meshes.begin(), world.meshes.end(),
                    [](const WorldMesh& mesh) { return !mesh.mesh.colors.empty(); })) {
        defines.push_back({"VERTEX_COLORS", "1"});
    }
    return defines;
}

} // namespace celadon
