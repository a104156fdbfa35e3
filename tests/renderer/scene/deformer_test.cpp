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
                                      parseDeformer("bend:z:80"), parseDeformer("wave:y:4:25"),
                                      parseDeformer("bend:x:50:0.4,0.5"), // beyond its range here
                                      parseDeformer("twist:x:-70:0.2,0.9")};
    ASSERT_EQ(stack.size(), 6u);
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

/// Offsets that no symmetry hides.
Lattice crookedLattice(const glm::ivec3& size) {
    Lattice lattice;
    lattice.size = size;
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        lattice.offsets.push_back(5.0 * glm::dvec3(std::sin(i * 1.7), std::cos(i * 2.3 + 1.0),
                                                   std::sin(i * 0.9 + 2.0)));
    }
    return lattice;
}

TEST(Lattice, AtRestNothingMoves) {
    Lattice lattice;
    lattice.size = {2, 5, 8};
    lattice.offsets.assign(80, glm::dvec3(0.0));
    for (const glm::dvec3& p : {kBox.low, kBox.high, glm::dvec3(3, 4, 5), glm::dvec3(-90, 80, 0)}) {
        const Mapped mapped = mapThrough(lattice, kBox, p);
        EXPECT_EQ(mapped.position, p);
        EXPECT_EQ(mapped.jacobian, glm::dmat3(1.0));
    }
}

TEST(Lattice, AffineControlPointsMoveSpaceByThatMapWithinTheBoxAndBeyond) {
    const glm::dmat3 linear(1.2, 0.3, -0.1, 0.0, 0.8, 0.4, 0.5, -0.2, 1.1);
    const auto affine = [&](const glm::dvec3& p) { return linear * p + glm::dvec3(3, -7, 2); };
    Lattice lattice;
    lattice.size = {3, 2, 4};
    for (int k = 0; k < 4; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 place = lattice.place({i, j, k}, kBox);
                lattice.offsets.push_back(affine(place) - place);
            }
        }
    }
    for (const glm::dvec3& p : {glm::dvec3(3, 4, 5), glm::dvec3(-90, 80, 40), kBox.high}) {
        const Mapped mapped = mapThrough(lattice, kBox, p);
        expectNear(mapped.position, affine(p), 1e-11);
        for (int c = 0; c < 3; ++c) {
            expectNear(mapped.jacobian[c], linear[c]);
        }
    }
}

// Sederberg and Parry's equation, by binomials, at the corners and in between.
TEST(Lattice, IsTheTrivariateBernsteinPolynomial) {
    const Lattice lattice = crookedLattice({3, 4, 2});
    const auto binomial = [](int n, int i) {
        return std::tgamma(n + 1) / std::tgamma(i + 1) / std::tgamma(n - i + 1);
    };
    for (const glm::dvec3& t : {glm::dvec3(0.3, 0.6, 0.8), glm::dvec3(0, 1, 0), glm::dvec3(1)}) {
        glm::dvec3 expected(0.0);
        for (int k = 0; k < lattice.size.z; ++k) {
            for (int j = 0; j < lattice.size.y; ++j) {
                for (int i = 0; i < lattice.size.x; ++i) {
                    const glm::ivec3 point(i, j, k);
                    double weight = 1.0;
                    for (int a = 0; a < 3; ++a) {
                        const int n = lattice.size[a] - 1;
                        weight *= binomial(n, point[a]) * std::pow(t[a], point[a]) *
                                  std::pow(1.0 - t[a], n - point[a]);
                    }
                    expected += weight * (lattice.place(point, kBox) +
                                          lattice.offsets[lattice.index(point)]);
                }
            }
        }
        const glm::dvec3 p = kBox.low + t * (kBox.high - kBox.low);
        expectNear(mapThrough(lattice, kBox, p).position, expected, 1e-11);
    }
}

TEST(Lattice, TheJacobianIsTheDerivativeAcrossTheBoxsBorderToo) {
    for (const glm::ivec3& size : {glm::ivec3(2), glm::ivec3(3, 8, 2), glm::ivec3(5)}) {
        const Lattice lattice = crookedLattice(size);
        for (const glm::dvec3& p :
             {glm::dvec3(3, 4, 5), glm::dvec3(-30, 4, 5), glm::dvec3(35, 50, -70), kBox.low}) {
            const double h = 1e-5;
            for (int c = 0; c < 3; ++c) {
                glm::dvec3 step(0.0);
                step[c] = h;
                const glm::dvec3 slope = (mapThrough(lattice, kBox, p + step).position -
                                          mapThrough(lattice, kBox, p - step).position) /
                                         (2.0 * h);
                // On the border itself the second derivative jumps, and h of it is seen.
                expectNear(mapThrough(lattice, kBox, p).jacobian[c], slope, 1e-5);
            }
        }
    }
}

TEST(Lattice, OneThatFlattensEverythingIsRefused) {
    Deformer deformer;
    deformer.kind = Deformer::Kind::Lattice;
    deformer.lattice = crookedLattice({3, 3, 3});
    EXPECT_NO_THROW(checkDeformers(std::span(&deformer, 1), kBox));
    for (int i = 0; i < 27; ++i) { // into the plane z = 1
        const glm::ivec3 point(i % 3, i / 3 % 3, i / 9);
        deformer.lattice.offsets[static_cast<std::size_t>(i)] = {
            0, 0, 1.0 - deformer.lattice.place(point, kBox).z};
    }
    EXPECT_THROW(checkDeformers(std::span(&deformer, 1), kBox), InputError);
    const RestBox flat{{0, 0, 0}, {1, 0, 1}};
    EXPECT_THROW(checkDeformers(std::span(&deformer, 1), flat), UsageError);
}

TEST(Deformer, BeyondItsRangeThingsOnlyGoAlong) {
    const glm::dvec3 center = 0.5 * (kBox.low + kBox.high);
    // y from -20 to 40: 0.25 to 0.75 is -5 to 25.
    expectNear(moved("twist:y:90:0.25,0.75", {20, -10, 0}), {20, -10, 0});
    expectNear(moved("twist:y:90:0.25,0.75", {10, 30, 0}), {20, 30, -10});
    expectNear(moved("taper:y:0.5:0.25,0.75", {14, 39, -10}), {12, 39, -10});
    const double radius = 30.0 / (std::numbers::pi / 2.0);
    expectNear(moved("bend:y:90:0.25,0.75", {center.x, 35, center.z}),
               {center.x, -5 + radius, center.z + radius + 10});
    expectNear(moved("wave:x:3:80:0,0.5", {25, 1, 2}), {25, 4, 2}); // stays at the quarter wave
    expectNear(moved("twist:y:90:0,1", {10, 7, 0}), moved("twist:y:90", {10, 7, 0}));
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
    EXPECT_EQ(parseDeformer("taper:y:2:0.2,0.9").range, glm::dvec2(0.2, 0.9));
    for (const char* const text :
         {"", "twist", "twist:y", "twist:w:90", "twist:yy:90", "twist:y:90:1",
          "twist:y:", "spin:y:9", "taper:x:-1", "wave:x:1:0", "wave:x:1", "inflate:x:1",
          "inflate:nan", "bend:z:1e999", "twist:y:1,2", "twist:y:90:0.5", "twist:y:90:0.8,0.2",
          "inflate:1:0,1"}) {
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
