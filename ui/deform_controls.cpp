#include "ui/deform_controls.h"

#include <glm/matrix.hpp>

#include <cmath>

namespace celadon::ui {

namespace {

using Kind = Deformer::Kind;

const AnimatedDeformer* chosenDeformer(const Session& session) {
    const MotionState& motion = session.motion;
    if (!session.hasWorld() || motion.selected < 0 ||
        motion.selected >= static_cast<int>(motion.now.deformers.size())) {
        return nullptr;
    }
    return &motion.now.deformers[static_cast<std::size_t>(motion.selected)];
}

/// What acts on the controls of the chosen deformer: those after a lattice, all of them after
/// handles, which come first.
std::vector<Deformer> deformersAfter(const Session& session, const AnimatedDeformer& chosen) {
    const DeformerStack& stack = session.motion.now.deformers;
    const std::size_t first =
        chosen.kind == Kind::Handles ? 0 : static_cast<std::size_t>(session.motion.selected) + 1;
    std::vector<Deformer> result;
    for (std::size_t i = first; i < stack.size(); ++i) {
        if (stack[i].isOn) {
            result.push_back(
                stack[i].at(session.motion.now.seconds, session.world().millimetersPerUnit));
        }
    }
    return result;
}

glm::dvec3 moved(std::span<const Deformer> deformers, const RestBox& box, const glm::dvec3& p) {
    DeformedVertex vertex{p, glm::dvec3(0.0), glm::dvec3(0.0)};
    deform(deformers, box, vertex);
    return vertex.position;
}

/// Before the deformers that follow, mm.
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
    const std::vector<Deformer> after = deformersAfter(session, *chosen);
    for (int i = 0; i < controlCount(*chosen); ++i) {
        result.push_back(
            {i, moved(after, session.mover().restBox(), ownPlace(session, *chosen, i))});
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
    const RestBox& box = session.mover().restBox();
    const std::vector<Deformer> after = deformersAfter(session, chosen);
    const glm::dvec3 place = ownPlace(session, chosen, index);
    // Back through what follows, by its derivative here.
    const double h = 1e-3 * session.world().scatteringSphere.radius;
    glm::dmat3 jacobian;
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 step(0.0);
        step[c] = h;
        jacobian[c] = (moved(after, box, place + step) - moved(after, box, place - step)) / (2.0 * h);
    }
    constexpr double kFlat = 1e-6;
    const glm::dvec3 own = std::abs(glm::determinant(jacobian)) > kFlat
                               ? glm::inverse(jacobian) * deltaMm
                               : deltaMm;
    const double unit = session.world().millimetersPerUnit;
    if (chosen.kind == Kind::Handles) {
        const Handle& handle = chosen.handles[static_cast<std::size_t>(index)];
        const glm::dvec3 move = place / unit - handle.at + own / unit;
        return {"deform.handle.change", {{"handle", index}, {"move", toJson(move)}}};
    }
    const glm::ivec3 size = chosen.latticeSize;
    const glm::ivec3 point(index % size.x, index / size.x % size.y, index / size.x / size.y);
    Lattice grid;
    grid.size = size;
    const glm::dvec3 by = (place + own - grid.place(point, box)) / unit;
    return {"deform.point",
            {{"deformer", session.motion.selected},
             {"point", {point.x, point.y, point.z}},
             {"by", toJson(by)}}};
}

} // namespace celadon::ui
