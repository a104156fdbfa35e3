#include "renderer/scene/deformer.h"

#include "renderer/scene/number_list.h"
#include "renderer/scene/pose_mesh.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace celadon {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr double kTwoPi = 2.0 * 3.14159265358979323846;

struct Form {
    Deformer::Kind kind;
    const char* text;
};
constexpr std::array kForms{
    Form{Deformer::Kind::Twist, "twist:AXIS:DEG"},
    Form{Deformer::Kind::Bend, "bend:AXIS:DEG"},
    Form{Deformer::Kind::Taper, "taper:AXIS:SCALE"},
    Form{Deformer::Kind::Wave, "wave:AXIS:AMPLITUDE_MM:WAVELENGTH_MM"},
    Form{Deformer::Kind::Inflate, "inflate:MM"},
};

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t colon = text.find(':');
        parts.push_back(text.substr(0, colon));
        if (colon == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(colon + 1);
    }
}

/// Where along its axis a deformer runs from nothing to all of it.
struct Course {
    double low;    ///< coordinate of t = 0
    double length; ///< to t = 1, mm
    bool isBounded;
};

Course courseOf(const Deformer& deformer, const RestBox& box) {
    const double low = box.low[deformer.axis];
    const double length = box.high[deformer.axis] - low;
    if (!deformer.range) {
        return {low, length, false};
    }
    return {low + deformer.range->x * length, (deformer.range->y - deformer.range->x) * length,
            true};
}

Mapped map(const Deformer& deformer, const RestBox& box, const glm::dvec3& p) {
    const int a = deformer.axis;
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    const glm::dvec3 center = 0.5 * (box.low + box.high);
    const Course course = courseOf(deformer, box);
    const double length = course.length;
    const double along = p[a] - course.low;
    const double s = course.isBounded ? std::clamp(along, 0.0, length) : along;
    const double beyond = along - s;
    const double slope = beyond == 0.0 ? 1.0 : 0.0; // of s
    const double u = p[b] - center[b];
    const double v = p[c] - center[c];
    Mapped result{p};
    switch (deformer.kind) {
    case Deformer::Kind::Twist: {
        const double rate = deformer.amount * kRadiansPerDegree / length;
        const double cosine = std::cos(rate * s);
        const double sine = std::sin(rate * s);
        const double turnedU = cosine * u - sine * v;
        const double turnedV = sine * u + cosine * v;
        result.position[b] = center[b] + turnedU;
        result.position[c] = center[c] + turnedV;
        result.jacobian[a][b] = -slope * rate * turnedV;
        result.jacobian[a][c] = slope * rate * turnedU;
        result.jacobian[b][b] = result.jacobian[c][c] = cosine;
        result.jacobian[b][c] = sine;
        result.jacobian[c][b] = -sine;
        break;
    }
    case Deformer::Kind::Bend: {
        const double rate = deformer.amount * kRadiansPerDegree / length;
        const double angle = rate * s;
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        // sin(angle) / rate and (1 - cos(angle)) / rate, without loss where the angle is small
        const double half = std::sin(0.5 * angle);
        const bool isFlat = std::abs(angle) < 1e-6;
        const double forth = (isFlat ? s : s * sine / angle) + beyond * cosine;
        const double across =
            (isFlat ? 0.5 * s * angle : s * 2.0 * half * half / angle) + beyond * sine;
        result.position[a] = course.low + forth - u * sine;
        result.position[b] = center[b] + across + u * cosine;
        result.jacobian[a][a] = (1.0 - slope * rate * u) * cosine;
        result.jacobian[a][b] = (1.0 - slope * rate * u) * sine;
        result.jacobian[b][a] = -sine;
        result.jacobian[b][b] = cosine;
        break;
    }
    case Deformer::Kind::Taper: {
        const double rate = (deformer.amount - 1.0) / length;
        const double scale = 1.0 + rate * s;
        result.position[b] = center[b] + scale * u;
        result.position[c] = center[c] + scale * v;
        result.jacobian[a][b] = slope * rate * u;
        result.jacobian[a][c] = slope * rate * v;
        result.jacobian[b][b] = result.jacobian[c][c] = scale;
        break;
    }
    case Deformer::Kind::Wave: {
        const double rate = kTwoPi / deformer.wavelengthMm;
        result.position[b] += deformer.amount * std::sin(rate * s);
        result.jacobian[a][b] = slope * deformer.amount * rate * std::cos(rate * s);
        break;
    }
    case Deformer::Kind::Lattice:
        return mapThrough(deformer.lattice, box, p);
    case Deformer::Kind::Inflate:
    case Deformer::Kind::Handles:
        break;
    }
    return result;
}

/// Keeps what it had where nothing is defined.
glm::dvec3 normalizedOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

} // namespace

Deformer parseDeformer(std::string_view text) {
    const std::string subject = fmt::format("--deform '{}'", text);
    const std::vector<std::string_view> parts = split(text);
    const Form* found = nullptr;
    for (const Form& form : kForms) {
        if (parts[0] == split(form.text)[0]) {
            found = &form;
        }
    }
    if (found == nullptr) {
        throw UsageError(subject, "no such deformer",
                         "choose one of twist, bend, taper, wave, inflate, or a FILE.json");
    }
    const std::string remedy = fmt::format("write {}", found->text);
    const std::size_t usual = split(found->text).size();
    const bool hasRange =
        found->kind != Deformer::Kind::Inflate && parts.size() == usual + 1;
    if (parts.size() != usual && !hasRange) {
        throw UsageError(subject, "has too few or too many parts", remedy);
    }
    const auto number = [&](std::string_view part) {
        const auto value = parseNumbers(part);
        if (!value || value->size() != 1) {
            throw UsageError(subject, fmt::format("'{}' is not a number", part), remedy);
        }
        return value->front();
    };
    Deformer result;
    result.kind = found->kind;
    if (result.kind == Deformer::Kind::Inflate) {
        result.amount = number(parts[1]);
        return result;
    }
    constexpr std::string_view kAxes = "xyz";
    if (parts[1].size() != 1 || kAxes.find(parts[1]) == std::string_view::npos) {
        throw UsageError(subject, fmt::format("'{}' is not an axis", parts[1]), "choose x, y or z");
    }
    result.axis = static_cast<int>(kAxes.find(parts[1]));
    result.amount = number(parts[2]);
    if (result.kind == Deformer::Kind::Taper && result.amount < 0.0) {
        throw UsageError(subject, "a negative scale turns the surface inside out",
                         "give 0 or more");
    }
    if (result.kind == Deformer::Kind::Wave) {
        result.wavelengthMm = number(parts[3]);
        if (!(result.wavelengthMm > 0.0)) {
            throw UsageError(subject, "the wavelength is not positive", remedy);
        }
    }
    if (hasRange) {
        const auto range = parseNumbers(parts.back());
        if (!range || range->size() != 2 || !((*range)[0] < (*range)[1])) {
            throw UsageError(
                subject, fmt::format("'{}' is no range", parts.back()),
                "write FROM,TO with FROM < TO, parts of the extent: 0 its low end, 1 its high end");
        }
        result.range = glm::dvec2((*range)[0], (*range)[1]);
    }
    return result;
}

void checkDeformers(std::span<const Deformer> deformers, const RestBox& box) {
    const auto requireExtent = [&](int axis, const char* remedy) {
        if (!(box.high[axis] > box.low[axis])) {
            throw UsageError("--deform",
                             fmt::format("the model has no extent along {}", "xyz"[axis]), remedy);
        }
    };
    for (std::size_t i = 0; i < deformers.size(); ++i) {
        const Deformer& deformer = deformers[i];
        const bool usesBox = deformer.kind == Deformer::Kind::Twist ||
                             deformer.kind == Deformer::Kind::Bend ||
                             deformer.kind == Deformer::Kind::Taper || deformer.range;
        if (usesBox) {
            requireExtent(deformer.axis, "choose another axis");
        }
        for (int axis = 0; deformer.kind == Deformer::Kind::Lattice && axis < 3; ++axis) {
            requireExtent(axis, "a lattice needs a solid: use other deformers");
        }
        if (deformer.kind == Deformer::Kind::Lattice && flattensAll(deformer.lattice, box)) {
            throw InputError(fmt::format("deformer {} of {}, a lattice", i + 1, deformers.size()),
                             "its control points lie in one plane, line or place: nothing is left",
                             "move them apart");
        }
    }
}

void deform(std::span<const Deformer> deformers, const RestBox& box, DeformedVertex& vertex) {
    for (const Deformer& deformer : deformers) {
        if (deformer.kind == Deformer::Kind::Inflate) {
            // A parallel surface has the same normals.
            vertex.position += deformer.amount * vertex.miter;
            continue;
        }
        if (deformer.kind == Deformer::Kind::Handles) {
            continue;
        }
        const Mapped mapped = map(deformer, box, vertex.position);
        const glm::dmat3 carrier = cofactors(mapped.jacobian);
        vertex.position = mapped.position;
        vertex.normal = normalizedOr(carrier * vertex.normal, vertex.normal);
        const double length = glm::length(vertex.miter);
        if (length > 0.0) {
            vertex.miter = length * normalizedOr(carrier * vertex.miter, vertex.miter / length);
        }
    }
}

} // namespace celadon
