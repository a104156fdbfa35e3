#include "renderer/scene/animated_deformer.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>

namespace celadon {

AnimatedDeformer::AnimatedDeformer(const Deformer& constant)
    : kind(constant.kind),
      axis(constant.axis),
      amount(KeyedNumbers::of(constant.amount)),
      wavelengthMm(KeyedNumbers::of(constant.wavelengthMm)),
      range(constant.range) {
    const Lattice& lattice = constant.lattice;
    for (std::size_t i = 0; i < lattice.offsets.size(); ++i) {
        const int n = static_cast<int>(i);
        if (lattice.offsets[i] != glm::dvec3(0.0)) {
            moves.push_back({{n % lattice.size.x, n / lattice.size.x % lattice.size.y,
                              n / lattice.size.x / lattice.size.y},
                             KeyedNumbers::of(lattice.offsets[i])});
        }
    }
    latticeSize = lattice.offsets.empty() ? latticeSize : lattice.size;
}

Deformer AnimatedDeformer::at(double seconds, double millimetersPerUnit) const {
    Deformer result;
    result.kind = kind;
    result.axis = axis;
    result.range = range;
    if (amountName(kind) != nullptr) {
        result.amount = amount.number(seconds);
    }
    if (kind == Deformer::Kind::Wave) {
        result.wavelengthMm = wavelengthMm.number(seconds);
    }
    if (kind == Deformer::Kind::Lattice) {
        result.lattice.size = latticeSize;
        result.lattice.offsets.assign(
            static_cast<std::size_t>(latticeSize.x * latticeSize.y * latticeSize.z),
            glm::dvec3(0.0));
        for (const LatticeMove& move : moves) {
            result.lattice.offsets[result.lattice.index(move.point)] =
                millimetersPerUnit * move.by.vector(seconds);
        }
    }
    return result;
}

std::vector<PlacedHandle> AnimatedDeformer::handlesAt(double seconds,
                                                      double millimetersPerUnit) const {
    std::vector<PlacedHandle> result;
    for (const Handle& handle : handles) {
        const glm::dvec3 angles = glm::radians(handle.turnDegrees.vector(seconds));
        glm::dquat turn(1.0, 0.0, 0.0, 0.0);
        for (int axis_ = 0; axis_ < 3; ++axis_) {
            glm::dvec3 direction(0.0);
            direction[axis_] = 1.0;
            turn = glm::angleAxis(angles[axis_], direction) * turn;
        }
        result.push_back({millimetersPerUnit * handle.at, millimetersPerUnit * handle.radius,
                          millimetersPerUnit * (handle.at + handle.move.vector(seconds)),
                          glm::mat3_cast(turn)});
    }
    return result;
}

double AnimatedDeformer::lastSeconds() const {
    double last = std::max(amount.lastSeconds(), wavelengthMm.lastSeconds());
    for (const LatticeMove& move : moves) {
        last = std::max(last, move.by.lastSeconds());
    }
    for (const Handle& handle : handles) {
        last = std::max({last, handle.move.lastSeconds(), handle.turnDegrees.lastSeconds()});
    }
    return last;
}

const char* deformerName(Deformer::Kind kind) {
    constexpr std::array kNames{"twist", "bend", "taper", "wave", "inflate", "lattice", "handles"};
    return kNames.at(static_cast<std::size_t>(kind));
}

const char* amountName(Deformer::Kind kind) {
    constexpr std::array kNames{"angleDegrees",
                                "angleDegrees",
                                "scale",
                                "amplitudeMm",
                                "distanceMm",
                                static_cast<const char*>(nullptr),
                                static_cast<const char*>(nullptr)};
    return kNames.at(static_cast<std::size_t>(kind));
}

} // namespace celadon
