#include "renderer/scene/motion.h"

#include "subedit/assert.h"

#include <algorithm>
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

/// The handles of a stack; null: none are on.
const AnimatedDeformer* handlesOf(const DeformerStack& deformers) {
    const auto found =
        std::find_if(deformers.begin(), deformers.end(), [](const AnimatedDeformer& deformer) {
            return deformer.isOn && deformer.kind == Deformer::Kind::Handles;
        });
    return found == deformers.end() ? nullptr : &*found;
}

/// Where handles are before they are moved; empty without any.
std::vector<PlacedHandle> restPlaces(const AnimatedDeformer* deformer, const World& rest) {
    std::vector<PlacedHandle> places;
    if (deformer != nullptr) {
        places = deformer->handlesAt(0.0, rest.millimetersPerUnit);
    }
    for (PlacedHandle& place : places) {
        place.to = place.at;
        place.turn = glm::dmat3(1.0);
    }
    return places;
}

} // namespace

Motion::Motion(const World& rest) : mRest(rest), mRestViewpoints{rest.cameras, rest.lights} {
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
    if (rest.rig->deformers) {
        setDeformers(*rest.rig->deformers);
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

std::vector<PlacedHandle> Motion::handlesNewIn(const DeformerStack& deformers) const {
    std::vector<PlacedHandle> places = restPlaces(handlesOf(deformers), mRest);
    return mHandles && places == restPlaces(handlesOf(mDeformers), mRest)
               ? std::vector<PlacedHandle>()
               : places;
}

void Motion::setDeformers(DeformerStack deformers) {
    const std::vector<PlacedHandle> places = handlesNewIn(deformers);
    deformers.swap(mDeformers);
    try {
        static_cast<void>(deformersAt(0.0));
        if (handlesOf(mDeformers) == nullptr) {
            mHandles.reset();
        } else if (!places.empty()) {
            mHandles = std::make_unique<HandleSolver>(mRest, places);
        }
    } catch (...) {
        mDeformers = std::move(deformers);
        throw;
    }
}

std::vector<std::string> Motion::warnings() const {
    return mHandles ? mHandles->warnings() : std::vector<std::string>();
}

std::optional<HandleSolver::Effort> Motion::handleEffort() const {
    return mHandles ? std::optional(mHandles->effort()) : std::nullopt;
}

std::vector<Deformer> Motion::deformersAt(double seconds) const {
    std::vector<Deformer> result;
    for (const AnimatedDeformer& deformer : mDeformers) {
        if (deformer.isOn) {
            result.push_back(deformer.at(seconds, mRest.millimetersPerUnit));
        }
    }
    checkDeformers(result, mBox);
    return result;
}

double Motion::durationSeconds() const {
    double duration = mAnimation ? animations()[*mAnimation].durationSeconds : 0.0;
    for (const AnimatedDeformer& deformer : mDeformers) {
        duration = std::max(duration, deformer.lastSeconds());
    }
    return duration;
}

Viewpoints Motion::viewpointsOf(const RigPose& pose) const {
    const Rig& rig = *mRest.rig;
    const double unit = mRest.millimetersPerUnit;
    Viewpoints result = mRestViewpoints;
    for (std::size_t i = 0; i < std::min(result.cameras.size(), rig.cameraNodes.size()); ++i) {
        follow(pose.nodes[static_cast<std::size_t>(rig.cameraNodes[i])], unit, result.cameras[i]);
    }
    for (std::size_t i = 0; i < std::min(result.lights.size(), rig.lightNodes.size()); ++i) {
        follow(pose.nodes[static_cast<std::size_t>(rig.lightNodes[i])], unit, result.lights[i]);
    }
    return result;
}

Viewpoints Motion::viewpointsAt(double seconds) const {
    return mRest.rig && mAnimation
               ? viewpointsOf(poseAt(*mRest.rig, animations()[*mAnimation], seconds))
               : mRestViewpoints;
}

Pose Motion::at(double seconds, Settling settling) const {
    Pose result;
    result.meshes.resize(mRest.meshes.size());
    result.mirrored.resize(mRest.meshes.size());
    result.deformers = deformersAt(seconds);
    if (const AnimatedDeformer* const held = handlesOf(mDeformers)) {
        result.nodes =
            mHandles->solve(held->handlesAt(seconds, mRest.millimetersPerUnit), settling);
    }
    result.box = mBox;
    static_cast<Viewpoints&>(result) = mRestViewpoints;
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
    if (mAnimation) {
        static_cast<Viewpoints&>(result) = viewpointsOf(pose);
    }
    return result;
}

} // namespace celadon
