#include "renderer/scene/deformer.h"
#include "renderer/scene/motion.h"
#include "subedit/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace celadon {
namespace {

const RestBox kBox{{-10.0, -20.0, -30.0}, {30.0, 40.0, 10.0}};

glm::dvec3 moved(const std::string& text, const glm::dvec3& position) {
    DeformedVertex vertex{position, {0, 0, 1}, glm::dvec3(0.0)};
    const Deformer deformer = parseDeformer(text);
    deform(std::span(&deformer, 1), kBox, vertex);
    return vertex.position;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Deformer, DoesNothingAtTheLowEnd) {
    for (const char axis : std::string("xyz")) {
        for (const char* const form : {"twist:?:70", "bend:?:-50", "taper:?:0.3", "wave:?:5:13"}) {
            std::string text = form;
            text[text.find('?')] = axis;
            glm::dvec3 p(7.0, -3.0, -12.0);
            p[axis - 'x'] = kBox.low[axis - 'x'];
            expectNear(moved(text, p), p);
        }
    }
}

TEST(Deformer, DoesAllOfItAtTheHighEnd) {
    const glm::dvec3 center = 0.5 * (kBox.low + kBox.high);      // 10, 10, -10
    expectNear(moved("twist:y:90", {10, 40, 0}), {20, 40, -10}); // from z towards x
    expectNear(moved("taper:z:0.5", {14, 20, 10}), {12, 15, 10});
    // The center line, 60 mm long, becomes a quarter of a circle towards z.
    const double radius = 60.0 / (std::numbers::pi / 2.0);
    expectNear(moved("bend:y:90", {center.x, 40, center.z}),
               {center.x, -20 + radius, center.z + radius});
    expectNear(moved("bend:y:1e-9", {1, 40, 2}), {1, 40, 2}, 1e-6);
    expectNear(moved("wave:x:3:16", {-6, 1, 2}), {-6, 4, 2}); // a quarter wave from the low end
}

TEST(Deformer, NormalsFollowTheJacobian) {
    const glm::dvec3 p(3.0, 17.0, -8.0);
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    const glm::dvec3 u = glm::normalize(glm::cross(n, glm::dvec3(1, 0, 0)));
    const glm::dvec3 v = glm::cross(n, u);
    const std::vector<Deformer> stack{parseDeformer("taper:x:0.4"), parseDeformer("twist:y:200"),
                                      parseDeformer("bend:z:80"), parseDeformer("wave:y:4:25")};
    for (std::size_t count = 1; count <= stack.size(); ++count) {
        const auto at = [&](const glm::dvec3& q) {
            DeformedVertex vertex{q, n, glm::dvec3(0.0)};
            deform(std::span(stack).first(count), kBox, vertex);
            return vertex;
        };
        const double h = 1e-4;
        const glm::dvec3 du = at(p + h * u).position - at(p - h * u).position;
        const glm::dvec3 dv = at(p + h * v).position - at(p - h * v).position;
        expectNear(at(p).normal, glm::normalize(glm::cross(du, dv)), 1e-6);
    }
}

/// A cube of side 2 with a vertex for each corner of each face, as a flat mesh has.
Mesh cube() {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const auto& [s, t] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                glm::vec3 p;
                p[axis] = side;
                p[(axis + 1) % 3] = side * static_cast<float>(s);
                p[(axis + 2) % 3] = static_cast<float>(t);
                glm::vec3 normal(0.0f);
                normal[axis] = side;
                mesh.positions.push_back(p);
                mesh.normals.push_back(normal);
            }
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) {
                mesh.indices.push_back(first + k);
            }
        }
    }
    return mesh;
}

TEST(Inflate, FacesMoveByTheAmountAndEdgesStayClosed) {
    const Mesh mesh = cube();
    const std::vector<glm::vec3> miters = miterDirections(mesh);
    for (std::size_t i = 0; i < miters.size(); ++i) {
        EXPECT_LT(glm::length(miters[i] - mesh.positions[i]), 1e-6f) << i; // corners: (1, 1, 1)
    }
}

TEST(Deformer, TextsAreParsedOrRefused) {
    EXPECT_EQ(parseDeformer("wave:z:-2.5:40").wavelengthMm, 40.0);
    EXPECT_EQ(parseDeformer("inflate:-3").amount, -3.0);
    for (const char* const text :
         {"", "twist", "twist:y", "twist:w:90", "twist:yy:90", "twist:y:90:1",
          "twist:y:", "spin:y:9", "taper:x:-1", "wave:x:1:0", "wave:x:1", "inflate:x:1",
          "inflate:nan", "bend:z:1e999", "twist:y:1,2"}) {
        EXPECT_THROW((void)parseDeformer(text), UsageError) << text;
    }
    const RestBox flat{{0, 0, 0}, {1, 0, 1}};
    const Deformer bend = parseDeformer("bend:y:10");
    EXPECT_THROW(checkDeformers(std::span(&bend, 1), flat), UsageError);
    const Deformer wave = parseDeformer("wave:y:1:10");
    EXPECT_NO_THROW(checkDeformers(std::span(&wave, 1), flat));
}

} // namespace
} // namespace celadon
