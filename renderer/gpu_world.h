#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_blocks.h"
#include "renderer/scene/world.h"

#include <memory>
#include <vector>

/// A world's geometry and looks on the GPU: the buffers that both the light and the camera passes
/// draw from.
namespace celadon {

class GpuWorld {
public:
    /// @throws ContextError when the GPU's memory does not hold it
    explicit GpuWorld(const World& world);

    /// Draws every mesh with the given program (surface.vert; DESIGN 3.1, 3.3). Sets the uniforms
    /// of include/surface.glsl, and with `looks` those of splatting_buffer.frag as well. Cut-outs
    /// are cut out either way.
    /// @param program compiled with sceneDefines()
    void draw(const gl::Program& program, bool looks) const;

    /// The buffers of one mesh, in the order of World::meshes, for what moves them
    /// (GpuDeformation).
    struct Geometry {
        const gl::Buffer& vertices; ///< kVertexFloats each: position in mm, normal, uv, uv1
        const gl::Buffer& indices;
        bool scatters;
    };
    static constexpr int kVertexFloats = 10;
    [[nodiscard]] std::size_t meshCount() const { return mMeshes.size(); }
    [[nodiscard]] Geometry geometry(std::size_t mesh) const {
        return {mMeshes[mesh].vertices, mMeshes[mesh].indices, mMeshes[mesh].scattering >= 0};
    }

    /// Bounding spheres, a blocks::BoundsBlock: those of the world at first, then what moves the
    /// vertices writes. Passes read it from there, so that nothing in a frame waits for it.
    [[nodiscard]] const gl::Buffer& bounds() const { return mBounds; }
    void bindBounds() const { mBounds.bindUniform(blocks::kBounds); }
    /// Waits for the GPU.
    [[nodiscard]] blocks::BoundsBlock readBounds() const;

private:
    static constexpr int kLookTextures = 4; ///< base color, metallic-roughness, normal, emission

    struct LookTexture {
        int image = -1;
        gl::Sampler sampler;
        int uvSet = -1; ///< -1: none
        glm::mat3 transform{1.0f};
    };
    struct Look {
        glm::vec4 baseColor;
        glm::vec4 lobe; ///< metallic, roughness, index of refraction or 0, normal scale
        glm::vec3 emission;
        float alphaCutoff; ///< -1: none
        bool doubleSided;
        LookTexture textures[kLookTextures];
    };
    struct GpuMesh {
        gl::Buffer vertices;
        gl::Buffer colors; ///< RGBA; empty where the mesh has none
        gl::Buffer indices;
        gl::VertexArray vertexArray;
        int indexCount = 0;
        int look = 0;
        int scattering = -1;
    };

    /// Base color and the first `textures` textures.
    void setBase(const gl::Program& program, const Look& look, int textures) const;
    void addLook(const World& world, const SurfaceMaterial& material);
    void addMesh(const WorldMesh& mesh);
    int addImage(const World& world, int image, bool srgb);
    LookTexture addTexture(const World& world, const TextureReference& reference, bool srgb);

    gl::Buffer mBounds;
    std::vector<GpuMesh> mMeshes;
    std::vector<Look> mLooks;
    std::vector<gl::Texture> mImages;
    std::vector<std::pair<int, bool>>
        mImageKeys; ///< (index in World::images, sRGB) of each of mImages
};

/// What the shaders of a world are compiled with besides each pass's own, so that others do not pay
/// for it: CUT_OUT where some surface is cut out by its alpha, VERTEX_COLORS where some mesh has
/// them.
[[nodiscard]] std::vector<gl::ShaderDefine> sceneDefines(const World& world);

} // namespace celadon
