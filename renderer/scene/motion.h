#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/handle_solver.h"
#include "renderer/scene/pose_mesh.h"
#include "renderer/scene/world.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Everything that moves a world: handles on its rest shape, one of its animations, and deformers
/// after it. Small: vertices
/// are moved by GpuDeformation, or by posedWorld() on the CPU.
///
///     Motion motion(world);                      // world at rest, its geometry stays so
///     motion.selectAnimation(0);
///     motion.setDeformers({parseDeformer("twist:y:90")});
///     const Pose pose = motion.at(1.5);          // seconds
namespace celadon {

/// Cameras and lights of a moment, in mm.
struct Viewpoints {
    std::vector<Camera> cameras; ///< of each of World::cameras
    std::vector<Light> lights;   ///< of each of World::lights
};

/// A moment of a world: what is needed to move every vertex, in mm.
struct Pose : Viewpoints {
    std::vector<MeshPose> meshes; ///< of each of World::meshes; without matrices: not bound
    std::vector<bool> mirrored;   ///< of each: its front became its back
    std::shared_ptr<const NodePose> nodes; ///< what handles do to the rest shape, before all else
    std::vector<Deformer> deformers;
    RestBox box;
};

class Motion {
public:
    /// @param rest outlives the motion; its meshes, cameras and lights are those at rest
    explicit Motion(const World& rest);

    /// Empty without a rig.
    [[nodiscard]] std::span<const Animation> animations() const;
    /// Nothing: the rest pose. @param number below animations().size()
    void selectAnimation(std::optional<std::size_t> number) { mAnimation = number; }
    /// Instead of those that are stored with the model, which a Motion begins with.
    /// @throws UsageError: an axis along which the world has no extent; InputError. Nothing has
    ///         changed then.
    void setDeformers(DeformerStack deformers);
    /// What setDeformers() would first need of World::handleGround: where the handles of a stack
    /// are at rest, unless this motion has them. Empty: nothing that takes long.
    [[nodiscard]] std::vector<PlacedHandle> handlesNewIn(const DeformerStack& deformers) const;
    [[nodiscard]] const DeformerStack& deformers() const { return mDeformers; }
    [[nodiscard]] const RestBox& restBox() const { return mBox; }
    /// What the user should know about the deformers, one line each.
    [[nodiscard]] std::vector<std::string> warnings() const;
    /// What the handles cost; nothing without any.
    [[nodiscard]] std::optional<HandleSolver::Effort> handleEffort() const;

    /// Whether any pose differs from the rest pose.
    [[nodiscard]] bool moves() const { return mAnimation.has_value() || !mDeformers.empty(); }
    /// Of the animation, or until the last key of the deformers; 0: nothing changes.
    [[nodiscard]] double durationSeconds() const;
    /// The animation starts over after its end; deformers stay as their last keys have them.
    /// @throws InputError for a lattice that flattens everything at that time
    [[nodiscard]] Pose at(double seconds, Settling settling = Settling::Full) const;
    /// That part of at() alone, quickly.
    [[nodiscard]] Viewpoints viewpointsAt(double seconds) const;

private:
    const World& mRest;
    Viewpoints mRestViewpoints;
    std::optional<RigPose> mRestPose;
    std::vector<double> mRestSigns; ///< of each mesh's first matrix
    std::optional<std::size_t> mAnimation;
    DeformerStack mDeformers;
    std::unique_ptr<HandleSolver> mHandles; ///< its solutions are kept; poses do not depend on it
    RestBox mBox;

    [[nodiscard]] Viewpoints viewpointsOf(const RigPose& pose) const;
    [[nodiscard]] std::vector<Deformer> deformersAt(double seconds) const;
};

/// A copy whose vertices are moved, on the CPU in double precision: cameras, lights and bounding
/// spheres follow, texture coordinates stay.
/// @throws InputError that names the mesh and the cause where a vertex leaves all numbers
[[nodiscard]] World posedWorld(const World& rest, const Pose& pose);

/// The vertices of one mesh, before they are rounded to float.
struct DeformedMesh {
    std::vector<glm::dvec3> positions; ///< mm
    std::vector<glm::dvec3> normals;   ///< unit length, or zero where no face has an area
};
[[nodiscard]] DeformedMesh deformedMesh(const World& rest, std::size_t mesh, const Pose& pose);

/// Where Inflate moves each vertex, per mm, in the space of the mesh's binding if it has one:
/// vertices at equal positions go together, and so far that faces which meet at an edge all move by
/// one mm (at edges sharper than some 150 degrees, less).
[[nodiscard]] std::vector<glm::vec3> miterDirections(const Mesh& rest);

/// @return whether Pose::deformers need them
[[nodiscard]] bool needsMiters(const Pose& pose);

/// Refuses a pose in which a vertex is not finite or beyond what squares in float, saying which
/// mesh and what moved it there; returns where all are well.
/// @throws InputError
void refuseExplosion(const World& rest, const Pose& pose);

} // namespace celadon
