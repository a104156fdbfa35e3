#include "ui/deform_controls.h"

#include <glm/matrix.hpp>

#include <cmath>
#include <limits>

namespace celadon::ui {

namespace {

using Kind = Deformer::Kind;

const AnimatedDeformer* chosenDeformer(const Session& session) {
    const MotionState& motion = session.motion;
    if (!session.hasWorld() || !motion.areControlsShown || motion.selected < 0 ||
        motion.selected >= static_cast<int>(motion.now.deformers.size())) {
        return nullptr;
    }
    return &motion.now.deformers[static_cast<std::size_t>(motion.selected)];
}

/// What acts on a control, one after the other.
struct Path {
    glm::dmat4 carrier{1.0}; ///< of the animation, at a handle
    std::vector<Deformer> deformers;
    RestBox box;

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const {
        DeformedVertex vertex{glm::dvec3(carrier * glm::dvec4(p, 1.0)), glm::dvec3(0.0),
                              glm::dvec3(0.0)};
        deform(deformers, box, vertex);
        return vertex.position;
    }
};

/// What skins and nodes do, at this moment, to the vertex that is nearest to a place of the rest
/// shape.
glm::dmat4 carrierAt(const Session& session, const glm::dvec3& placeMm) {
    const World& world = session.world();
    if (!world.rig) {
        return glm::dmat4(1.0);
    }
    double least = std::numeric_limits<double>::infinity();
    const Mesh* mesh = nullptr;
    std::size_t nearest = 0;
    for (const WorldMesh& part : world.meshes) {
        for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
            const double distance = glm::distance(glm::dvec3(part.mesh.positions[i]), placeMm);
            if (distance < least) {
                least = distance;
                mesh = &part.mesh;
                nearest = i;
            }
        }
    }
    if (mesh == nullptr || !mesh->binding) {
        return glm::dmat4(1.0);
    }
    const MotionSetting& now = session.motion.now;
    const Rig& rig = *world.rig;
    const auto matrix = [&](const RigPose& pose) {
        return blendedMatrix(*mesh->binding,
                             meshPose(rig, *mesh->binding, pose, world.millimetersPerUnit),
                             mesh->bindingVertices[nearest]);
    };
    const glm::dmat4 atRest = matrix(restPose(rig));
    return now.animation && glm::determinant(glm::dmat3(atRest)) != 0.0
               ? matrix(poseAt(rig, rig.animations[*now.animation], now.seconds)) *
                     glm::inverse(atRest)
               : glm::dmat4(1.0);
}

/// A lattice's points go through the deformers after it; handles, which come first, through all
/// that there is.
Path pathOf(const Session& session, const AnimatedDeformer& chosen, int index) {
    const double unit = session.world().millimetersPerUnit;
    const bool isHandle = chosen.kind == Kind::Handles;
    const DeformerStack& stack = session.motion.now.deformers;
    Path path;
    path.box = session.mover().restBox();
    if (isHandle) {
        path.carrier =
            carrierAt(session, unit * chosen.handles[static_cast<std::size_t>(index)].at);
    }
    const auto first = isHandle ? 0 : static_cast<std::size_t>(session.motion.selected) + 1;
    for (std::size_t i = first; i < stack.size(); ++i) {
        if (stack[i].isOn) {
            path.deformers.push_back(stack[i].at(session.motion.now.seconds, unit));
        }
    }
    return path;
}

/// Before all that follows, mm.
glm::dvec3 ownPlace(const Session& session, const AnimatedDeformer& chosen, int index) {
    const double seconds = session.motion.now.seconds;
    const double unit = session.world().millimetersPerUnit;
    if (chosen.kind == Kind::Handles) {
        return chosen.handlesAt(seconds, unit)[static_cast<std::size_t>(index)].to;
    }
    const Lattice lattice = chosen.at(seconds, unit).lattice;
    const glm::ivec3& size = lattice.size;
    const glm::ivec3 point(index % size.x, index / size.x % size.y, index / size.x / size.y);
    return lattice.place(point, session.mover().restBox()) +
           lattice.offsets[static_cast<std::size_t>(index)];
}

int controlCount(const AnimatedDeformer& chosen) {
    switch (chosen.kind) {
    case Kind::Handles:
        return static_cast<int>(chosen.handles.size());
    case Kind::Lattice:
        return chosen.latticeSize.x * chosen.latticeSize.y * chosen.latticeSize.z;
    default:
        return 0;
    }
}

} // namespace

std::vector<DeformControl> shownControls(const Session& session) {
    std::vector<DeformControl> result;
    const AnimatedDeformer* const chosen = chosenDeformer(session);
    if (chosen == nullptr || !chosen->isOn) {
        return result;
    }
    const bool isLattice = chosen->kind == Kind::Lattice;
    const int count = controlCount(*chosen);
    Path path = isLattice ? pathOf(session, *chosen, 0) : Path();
    for (int i = 0; i < count; ++i) {
        if (!isLattice) {
            path = pathOf(session, *chosen, i);
        }
        result.push_back({i, path(ownPlace(session, *chosen, i))});
    }
    return result;
}

std::vector<std::array<int, 2>> controlLines(const Session& session) {
    std::vector<std::array<int, 2>> lines;
    const AnimatedDeformer* const chosen = chosenDeformer(session);
    if (chosen == nullptr || !chosen->isOn || chosen->kind != Kind::Lattice) {
        return lines;
    }
    const glm::ivec3 size = chosen->latticeSize;
    const glm::ivec3 strides(1, size.x, size.x * size.y);
    for (int i = 0; i < controlCount(*chosen); ++i) {
        const glm::ivec3 point(i % size.x, i / size.x % size.y, i / size.x / size.y);
        for (int axis = 0; axis < 3; ++axis) {
            if (point[axis] + 1 < size[axis]) {
                lines.push_back({i, i + strides[axis]});
            }
        }
    }
    return lines;
}

Command dragControl(const Session& session, int index, const glm::dvec3& deltaMm) {
    const AnimatedDeformer& chosen = *chosenDeformer(session);
    const Path path = pathOf(session, chosen, index);
    const glm::dvec3 place = ownPlace(session, chosen, index);
    // Back through what follows, by its derivative here.
    const double h = 1e-3 * session.world().scatteringSphere.radius;
    glm::dmat3 jacobian;
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 step(0.0);
        step[c] = h;
        jacobian[c] = (path(place + step) - path(place - step)) / (2.0 * h);
    }
    constexpr double kFlat = 1e-6;
    const glm::dvec3 own =
        std::abs(glm::determinant(jacobian)) > kFlat ? glm::inverse(jacobian) * deltaMm : deltaMm;
    const double unit = session.world().millimetersPerUnit;
    if (chosen.kind == Kind::Handles) {
        const Handle& handle = chosen.handles[static_cast<std::size_t>(index)];
        const glm::dvec3 move = place / unit - handle.at + own / unit;
        return {
            "deform.handle.change",
            {{"handle", index}, {"move", toJson(move)}, {"seconds", session.motion.now.seconds}}};
    }
    const glm::ivec3 size = chosen.latticeSize;
    const glm::ivec3 point(index % size.x, index / size.x % size.y, index / size.x / size.y);
    Lattice grid;
    grid.size = size;
    const glm::dvec3 by = (place + own - grid.place(point, path.box)) / unit;
    return {"deform.point",
            {{"deformer", session.motion.selected},
             {"point", {point.x, point.y, point.z}},
             {"by", toJson(by)},
             {"seconds", session.motion.now.seconds}}};
}

} // namespace celadon::ui
