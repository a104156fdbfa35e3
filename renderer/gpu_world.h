#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/buffer_texture.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_blocks.h"
#include "renderer/raster/triangle_raster.h"
#include "renderer/scene/world.h"

#include <memory>
#include <vector>

/// A world's geometry and looks on the GPU: the buffers that both the light and the camera passes
/// draw from (SurfaceDraw).
namespace celadon {

/// Who finds which triangle a pixel sees: the driver, or the processor (renderer/raster), which is
/// faster where the driver is software. Auto: the latter there, if the geometry fits into what its
/// shaders can address.
enum class Rasterizer { Auto, Driver, Processor };

class GpuWorld {
public:
    /// @param world outlives this @throws ContextError when the GPU's memory does not hold it
    explicit GpuWorld(const World& world, Rasterizer rasterizer = Rasterizer::Auto);

    [[nodiscard]] std::size_t meshCount() const { return mMeshes.size(); }
    /// Never Auto.
    [[nodiscard]] Rasterizer rasterizer() const { return mRasterizer; }

    /// Sets the uniforms of include/surface.glsl for a mesh, and with `looks` those of
    /// splatting_buffer.frag and its textures as well. A cut-out's base color is set either way.
    /// @param program in use, compiled with sceneDefines()
    void setMesh(const gl::Program& program, std::size_t mesh, bool looks) const;
    /// After the last mesh.
    static void unbindLooks();
    /// Draws the triangles of every mesh by the driver, with a program of surface.vert.
    void draw(const gl::Program& program, bool looks) const;

    /// For Rasterizer::Processor: what the vertices' buffer holds now, once the GPU has written it.
    /// The result is valid until the next.
    const TriangleRaster& rasterize(const RasterView& view) const;
    /// The textures of include/visible_triangle.glsl.
    void bindTriangles() const;
    /// The place of a mesh as there, and of all meshes.
    [[nodiscard]] glm::ivec4 placeOf(std::size_t mesh) const;
    [[nodiscard]] const gl::Buffer& places() const { return mPlaces; }

    static constexpr int kVertexFloats = 10; ///< position in mm, normal, uv, uv1
    /// The place of a mesh in the buffers, in the order of World::meshes, for what moves it
    /// (GpuDeformation).
    struct Geometry {
        const gl::Buffer& vertexBuffer;
        const gl::Buffer& indexBuffer;
        int firstVertex, vertexCount;
        int firstCorner, triangleCount;
        bool scatters;

        /// Vertices of the mesh and, as triples of its own vertices' numbers, its triangles.
        void bindVertices(GLuint storageBinding) const;
        void bindIndices(GLuint storageBinding) const;
        [[nodiscard]] std::vector<float> readVertices() const;
        [[nodiscard]] std::vector<std::uint32_t> readIndices() const;
    };
    [[nodiscard]] Geometry geometry(std::size_t mesh) const;

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
        int firstVertex = 0, vertexCount = 0; ///< multiples of kVertexUnit begin a mesh
        int firstTriangle = 0, triangleCount = 0;
        int firstCorner = 0; ///< in the buffer of indices, which has gaps between meshes
        int look = 0;
        int scattering = -1;
    };

    /// Base color and the first `textures` textures.
    void setBase(const gl::Program& program, const Look& look, int textures) const;
    void addLook(const World& world, const SurfaceMaterial& material);
    void placeMeshes();
    void fillBuffers();
    [[nodiscard]] bool canBeRasterized() const;
    int addImage(const World& world, int image, bool srgb);
    LookTexture addTexture(const World& world, const TextureReference& reference, bool srgb);

    const World& mWorld;
    Rasterizer mRasterizer;
    gl::Buffer mBounds;
    gl::Buffer mVertices, mIndices; ///< of all meshes
    gl::Buffer mColors;             ///< RGBA of all vertices; none where no mesh has them
    gl::Buffer mPlaces;             ///< see placeOf()
    gl::BufferTexture mVertexPairs, mCornerVertices, mVertexColors; ///< the same for fetches
    gl::VertexArray mVertexArray;
    std::vector<GpuMesh> mMeshes;
    std::unique_ptr<TriangleRaster> mRaster;
    std::vector<Look> mLooks;
    std::vector<gl::Texture> mImages;
    std::vector<std::pair<int, bool>>
        mImageKeys; ///< (index in World::images, sRGB) of each of mImages
};

/// What the shaders of a world are compiled with besides each pass's own, so that others do not pay
/// for it: CUT_OUT where some surface is cut out by its alpha, VERTEX_COLORS where some mesh has
/// them, VISIBLE_TRIANGLES for Rasterizer::Processor.
[[nodiscard]] std::vector<gl::ShaderDefine> sceneDefines(const World& world, Rasterizer rasterizer);

} // namespace celadon
