#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/buffer_texture.h"
#include "renderer/gl/program.h"
#include "renderer/gl/shader_library.h"
#include "renderer/gpu_world.h"
#include "renderer/scene/motion.h"

#include <memory>
#include <vector>

/// Moves the vertices of a GpuWorld, on the GPU, once a frame: morph targets, handles, skins and
/// nodes, then deformers, into the very buffers that the light and the camera passes draw from. The
/// CPU sends matrices and weights and waits for nothing; it never touches a vertex. The bounds go
/// from buffer to buffer as well, to GpuWorld::bounds(). Texture coordinates stay, so that the
/// material stays glued to the surface.
namespace celadon {

class GpuDeformation {
public:
    /// @param rest at rest, the world that `target` was made of; both outlive the deformation
    GpuDeformation(const gl::ShaderLibrary& shaders, const World& rest, const GpuWorld& target);

    /// Does not wait for the GPU. A vertex that is not finite is drawn as it is: see bounds().
    /// @param pose of a Motion of the same world
    void apply(const Pose& pose);

    /// Of the moved vertices, as World has them at rest.
    struct Bounds {
        BoundingSphere scattering;
        BoundingSphere scene;
    };

    /// What the last apply() came to. Waits for the GPU: after a frame, not before it.
    /// @param pose the same
    /// @throws InputError that names the mesh and the cause, when a vertex is not finite; the
    ///         buffers then hold what they hold, until the next apply()
    [[nodiscard]] Bounds bounds(const Pose& pose) const;

private:
    struct Target {
        gl::Buffer vertices, changes;
        int count = 0;
    };
    struct MovedMesh {
        gl::Buffer bound;   ///< position and normal of each vertex of the binding
        gl::Buffer morphed; ///< the same with morph targets on; none without
        gl::Buffer map, influences, matrices, miters;
        gl::Buffer vertexNodes, restMatrices;
        gl::BufferTexture matrixTexels, vertexNodeTexels, restMatrixTexels; ///< of these buffers
        gl::Buffer
            handled; ///< position, normal and miter of each drawn vertex; none without handles
        std::vector<Target> targets;
        int vertices = 0;
        int triangles = 0;
        int influenceCount = 0;
        bool isFlat = false;
        bool isBound = false;
        bool isMirrored = false; ///< triangles are turned over now
        bool isMoved = false;    ///< not at rest now
    };

    void addMesh(const WorldMesh& source);
    void move(std::size_t mesh, const Pose& pose);
    [[nodiscard]] const gl::Buffer& morph(MovedMesh& mesh, const std::vector<double>& weights);
    [[nodiscard]] const gl::Buffer& moveByNodes(MovedMesh& mesh, const gl::Buffer& bound,
                                                int flags);
    void bindVertices(const MovedMesh& mesh, const gl::Buffer& source,
                      const gl::BufferTexture& matrices) const;
    [[nodiscard]] const gl::Buffer& orNothing(const gl::Buffer& buffer) const;
    void sendDeformers(const Pose& pose);
    void sendNodes(const NodePose& pose);
    void measure();

    const World& mRest;
    const GpuWorld& mTarget;
    gl::Program mMorph, mHandles, mDeform, mDeformLattices, mFlatNormals, mFlip, mBoundsOf;
    gl::Buffer mNothing; ///< stands for a buffer that a mesh does not have
    gl::Buffer mDeformers, mLatticeOffsets, mNodes;
    gl::BufferTexture mDeformerTexels, mNodeTexels;
    std::shared_ptr<const NodeBinding> mNodeBinding; ///< that the meshes have
    gl::Buffer mBounds;
    std::vector<MovedMesh> mMeshes;
};

} // namespace celadon
