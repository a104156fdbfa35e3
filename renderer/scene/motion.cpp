#include "renderer/scene/motion.h"

#include "subedit/assert.h"

#include <cmath>
#include <limits>

namespace celadon {

namespace {

glm::dvec3 directionOr(const glm::dvec4& v, const glm::dvec3& otherwise) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::dvec3(v) / length : otherwise;
}

/// As the loader makes it from its node; the distance to what it looks at stays.
void follow(const glm::dmat4& node, double unit, Camera& camera) {
    const double distance = glm::length(camera.at - camera.eye);
    const glm::dvec3 before = (camera.at - camera.eye) / distance;
    camera.eye = unit * glm::dvec3(node[3]);
    camera.at = camera.eye + distance * -directionOr(node[2], -before);
    camera.up = directionOr(node[1], camera.up);
}

void follow(const glm::dmat4& node, double unit, Light& light) {
    light.position = unit * glm::dvec3(node[3]);
    light.direction = -directionOr(node[2], -light.direction);
}

/// Of the matrix that most vertices of a mesh share, or that of its first joint.
double orientation(const MeshPose& pose) {
    return glm::determinant(glm::dmat3(pose.matrices.front()));
}

} // namespace

Motion::Motion(const World& rest) : mRest(rest), mCameras(rest.cameras), mLights(rest.lights) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    mBox = {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (const WorldMesh& part : rest.meshes) {
        for (std::size_t i = 0; part.scattering >= 0 && i < part.mesh.positions.size(); ++i) {
            mBox.low = glm::min(mBox.low, glm::dvec3(part.mesh.positions[i]));
            mBox.high = glm::max(mBox.high, glm::dvec3(part.mesh.positions[i]));
        }
    }
    if (!rest.rig) {
        return;
    }
    mRestPose = restPose(*rest.rig);
    for (const WorldMesh& part : rest.meshes) {
        const MeshBinding* const binding = part.mesh.binding.get();
        mRestSigns.push_back(
            binding == nullptr
                ? 1.0
                : orientation(meshPose(*rest.rig, *binding, *mRestPose, rest.millimetersPerUnit)));
    }
}

std::span<const Animation> Motion::animations() const {
    return mRest.rig ? std::span<const Animation>(mRest.rig->animations)
                     : std::span<const Animation>();
}

void Motion::setDeformers(std::vector<Deformer> deformers) {
    checkDeformers(deformers, mBox);
    mDeformers = std::move(deformers);
}

Pose Motion::at(double seconds) const {
    Pose result;
    result.meshes.resize(mRest.meshes.size());
    result.mirrored.resize(mRest.meshes.size());
    result.deformers = mDeformers;
    result.box = mBox;
    result.cameras = mCameras;
    result.lights = mLights;
    if (!mRest.rig) {
        return result;
    }
    CELADON_ASSERT(!mAnimation || *mAnimation < animations().size());
    const Rig& rig = *mRest.rig;
    const double unit = mRest.millimetersPerUnit;
    const RigPose pose =
        mAnimation ? poseAt(rig, rig.animations[*mAnimation], seconds) : *mRestPose;
    for (std::size_t m = 0; m < mRest.meshes.size(); ++m) {
        if (const MeshBinding* const binding = mRest.meshes[m].mesh.binding.get()) {
            result.meshes[m] = meshPose(rig, *binding, pose, unit);
            result.mirrored[m] = orientation(result.meshes[m]) * mRestSigns[m] < 0.0;
        }
    }
    for (std::size_t i = 0; mAnimation && i < result.cameras.size() && i < rig.cameraNodes.size();
         ++i) {
        follow(pose.nodes[static_cast<std::size_t>(rig.cameraNodes[i])], unit, result.cameras[i]);
    }
    for (std::size_t i = 0; mAnimation && i < result.lights.size() && i < rig.lightNodes.size();
         ++i) {
        follow(pose.nodes[static_cast<std::size_t>(rig.lightNodes[i])], unit, result.lights[i]);
    }
    return result;
}

} // namespace celadon
