#include "load_support.h"

#include <cmath>
#include <map>
#include <tuple>

/// OBJ, PLY, OFF and STL: what they have in common, and what is their own.
namespace celadon {

namespace {

using loadtest::bytesOf;
using loadtest::refusal;
using loadtest::TemporaryFolder;
using testing::HasSubstr;

/// Corners of a unit cube, and its faces as quads that face outwards.
const std::vector<glm::vec3> kCubeCorners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<std::array<int, 4>> kCubeFaces{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string cubeObj() {
    std::string text = "# a cube\no cube\n";
    for (const glm::vec3& p : kCubeCorners) {
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                "\n";
    }
    for (const auto& face : kCubeFaces) {
        text += "f";
        for (const int corner : face) {
            text += " " + std::to_string(corner + 1);
        }
        text += "\n";
    }
    return text;
}

std::string cubeOff() {
    std::string text = "OFF\n8 6 12\n";
    for (const glm::vec3& p : kCubeCorners) {
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    for (const auto& face : kCubeFaces) {
        text += "4";
        for (const int corner : face) {
            text += " " + std::to_string(corner);
        }
        text += " 255 0 0\n";
    }
    return text;
}

template<typename T>
std::string encoded(T value, bool bigEndian) {
    std::string bytes = bytesOf(value);
    if (bigEndian) {
        std::reverse(bytes.begin(), bytes.end());
    }
    return bytes;
}

std::string cubePly(const std::string& format) {
    std::string text = "ply\nformat " + format +
                       " 1.0\ncomment made by a test\nelement vertex 8\nproperty double x\n"
                       "property float y\nproperty float z\nproperty uchar red\n"
                       "element face 6\nproperty list uchar ushort vertex_indices\n"
                       "property int flags\nend_header\n";
    const bool big = format == "binary_big_endian";
    for (const glm::vec3& p : kCubeCorners) {
        if (format == "ascii") {
            text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                    " 255\n";
        } else {
            text += encoded(static_cast<double>(p.x), big) + encoded(p.y, big) + encoded(p.z, big) +
                    "\xff";
        }
    }
    for (const auto& face : kCubeFaces) {
        text += format == "ascii" ? "4 " : "\x04";
        for (const int corner : face) {
            text += format == "ascii" ? std::to_string(corner) + " "
                                      : encoded(static_cast<std::uint16_t>(corner), big);
        }
        text += format == "ascii" ? "-1\n" : encoded(std::int32_t{-1}, big);
    }
    return text;
}

std::string cubeStl(bool binary) {
    std::string ascii = "solid a cube\n";
    std::string facets;
    std::uint32_t count = 0;
    for (const auto& face : kCubeFaces) {
        for (const auto& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            ascii += "facet normal 0 0 0\n outer loop\n";
            facets += std::string(12, '\0');
            for (const int k : triangle) {
                const glm::vec3 p =
                    kCubeCorners[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])];
                ascii += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                         std::to_string(p.z) + "\n";
                facets += bytesOf(p.x) + bytesOf(p.y) + bytesOf(p.z);
            }
            ascii += " endloop\nendfacet\n";
            facets += std::string(2, '\0');
            ++count;
        }
    }
    std::string header = "solid but binary all the same";
    header.resize(80, ' ');
    return binary ? header + bytesOf(count) + facets : ascii + "endsolid a cube\n";
}

/// Closed, all triangles facing outwards: the divergence theorem gives the volume.
double volumeOf(const Mesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

struct CubeFile {
    const char* name;
    std::string content;
};

class CubeTest : public testing::TestWithParam<CubeFile> {};

TEST_P(CubeTest, IsTheSameSolidInEveryFormat) {
    const TemporaryFolder folder;
    const Scene scene = loadScene(folder.write(GetParam().name, GetParam().content));
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.triangleCount(), 12u);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_TRUE(mesh.uvs.empty());
    EXPECT_FALSE(scene.millimetersPerUnit);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_NEAR(volumeOf(mesh), 1.0, 1e-6);
    // Angle weights make a cube's normals its diagonals, however its quads are split.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 diagonal = glm::normalize(mesh.positions[i] - glm::vec3(0.5f));
        EXPECT_NEAR(glm::dot(mesh.normals[i], diagonal), 1.0f, 1e-6f);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, CubeTest,
    testing::Values(CubeFile{"cube.obj", cubeObj()}, CubeFile{"cube.OFF", cubeOff()},
                    CubeFile{"ascii.ply", cubePly("ascii")},
                    CubeFile{"little.Ply", cubePly("binary_little_endian")},
                    CubeFile{"big.ply", cubePly("binary_big_endian")},
                    CubeFile{"ascii.stl", cubeStl(false)}, CubeFile{"binary.STL", cubeStl(true)}),
    [](const auto& instance) {
        return std::filesystem::path(instance.param.name).stem().string() +
               std::filesystem::path(instance.param.name).extension().string().substr(1);
    });

class PolygonFileTest : public testing::Test {
protected:
    TemporaryFolder mFolder;

    [[nodiscard]] Scene load(const std::string& name, std::string_view content) const {
        return loadScene(mFolder.write(name, content));
    }
    [[nodiscard]] std::string refused(const std::string& name, std::string_view content) const {
        return refusal(mFolder.write(name, content));
    }
};

constexpr const char* kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(PolygonFileTest, ObjHasUvsUpAndKeepsNormalsOfCorners) {
    const Scene scene = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                      "vt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 1\n"
                                      "vn 0 0 2\nvn 0 3 4\n"
                                      "f 1/1/1 2/2/1 3/3/1\nf 1/1/2 3/3/2 4/4/2\n");
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 6u); // two are split by their normals
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0.6f, 0.8f));
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0, 1));
    EXPECT_EQ(mesh.uvs[2], glm::vec2(1, 0.25f));
}

TEST_F(PolygonFileTest, ObjCountsBackwardsToo) {
    const Mesh mesh = load("a.obj", std::string(kThreeVertices) + "f -3 -2 -1\n").meshes[0];
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(PolygonFileTest, ObjFacesMayComeFirst) {
    EXPECT_EQ(load("a.obj", std::string("f 1 2 3\n") + kThreeVertices).meshes[0].triangleCount(),
              1u);
}

TEST_F(PolygonFileTest, ObjLinesMayEndInAnyWayAndContinue) {
    const Scene scene =
        load("a.obj", "\xef\xbb\xbfv 0 0 0 # first\r\nv 1 0 0\rv 0 +1e0 \\\r\n 0\r\n"
                      "usemtl x y\r\nf 1 2 \\\n3");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(PolygonFileTest, ObjColorsAndWeightsAreIgnored) {
    EXPECT_EQ(
        load("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 1.0\nv 0 1 0\nf 1 2 3\n").meshes[0].triangleCount(),
        1u);
}

TEST_F(PolygonFileTest, UselessNormalsAreComputed) {
    const Scene scene =
        load("a.obj", std::string(kThreeVertices) + "vn 0 0 0\nvn -nan(ind) nan 0\nvn 1 0 0\n"
                                                    "f 1//1 2//2 3//3\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[2], glm::vec3(1, 0, 0));
}

TEST_F(PolygonFileTest, IncompleteUvsAreDroppedWithAWarning) {
    const Scene scene = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n"
                                      "f 1/1 2/1 3/1\nf 1 3 4\n");
    EXPECT_TRUE(scene.meshes[0].uvs.empty());
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("3 of 6 corners have no texture coordinates"));
}

TEST_F(PolygonFileTest, SmoothingIgnoresThatVerticesAreRepeated) {
    // A roof whose ridge is given twice: its normals there are the mean all the same.
    const Scene scene = load("a.obj", "v 0 0 0\nv 1 0 1\nv 0 1 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\n"
                                      "v 1 0 1\nv 2 0 0\nv 1 1 1\n"
                                      "f 1 2 3\nf 4 5 6\nf 7 8 9\n");
    const Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (mesh.positions[i] == mesh.positions[j]) {
                EXPECT_EQ(mesh.normals[i], mesh.normals[j]);
            }
        }
    }
}

TEST_F(PolygonFileTest, SheetsWithTwoSidesHaveNormals) {
    const Mesh mesh = load("a.obj", std::string(kThreeVertices) + "f 1 2 3\nf 3 2 1\n").meshes[0];
    EXPECT_EQ(mesh.triangleCount(), 2u);
    for (const glm::vec3& normal : mesh.normals) {
        EXPECT_NEAR(std::abs(normal.z), 1.0f, 1e-6f);
    }
}

TEST_F(PolygonFileTest, FacesAtNonManifoldEdgesAllStay) {
    // Three triangles share an edge, and one is there twice.
    testing::internal::CaptureStderr();
    const Scene scene = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\n"
                                      "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 5\n");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 4u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 5u);
}

TEST_F(PolygonFileTest, TrianglesOfNoAreaAndUnusedVerticesGo) {
    const Scene scene = load("a.obj", std::string(kThreeVertices) +
                                          "v 9 9 9\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 5\n");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("left out 2 triangles of no area"));
}

TEST_F(PolygonFileTest, WhatIsSkippedIsSaid) {
    const Scene scene = load("a.obj", std::string(kThreeVertices) +
                                          "l 1 2\np 1\nf 1 2\nf 1 2 3\ncurv 0 1 1 2\nwobble 3\n");
    EXPECT_THAT(scene.warnings,
                testing::UnorderedElementsAre(HasSubstr("2 elements of points or lines"),
                                              HasSubstr("1 free-form curve"),
                                              HasSubstr("1 face with fewer than three corners"),
                                              HasSubstr("the first being 'wobble' in line 9")));
}

TEST_F(PolygonFileTest, ObjMistakesAreNamedWithTheirLine) {
    const std::string v = kThreeVertices;
    EXPECT_THAT(refused("a.obj", v + "f 1 2 9\n"),
                HasSubstr("a.obj', line 4: vertex index 9 is past the 3 vertices of the file; "));
    EXPECT_THAT(refused("a.obj", v + "f 1 2 -4\n"),
                HasSubstr("line 4: vertex index -4 goes back past the 3 read so far"));
    EXPECT_THAT(refused("a.obj", v + "f 0 1 2\n"), HasSubstr("line 4: vertex index is 0"));
    EXPECT_THAT(refused("a.obj", v + "f 1/1 2/1 3/1\n"),
                HasSubstr("texture coordinate index 1 is past the 0"));
    EXPECT_THAT(refused("a.obj", v + "f 1 2 4294967296\n"), HasSubstr("line 4"));
    EXPECT_THAT(refused("a.obj", v + "f 1 2 99999999999999999999\n"),
                HasSubstr("not a whole number in range"));
    EXPECT_THAT(refused("a.obj", v + "f 1 2 3x\n"), HasSubstr("'3x'"));
    EXPECT_THAT(refused("a.obj", v + "v 0 nan 0\n"),
                HasSubstr("line 4: y of a vertex is 'nan', not a finite number"));
    EXPECT_THAT(refused("a.obj", v + "v 0 0 1e39\n"), HasSubstr("z of a vertex"));
    EXPECT_THAT(refused("a.obj", v + "v 0 inf 0\n"), HasSubstr("not a finite number"));
    EXPECT_THAT(refused("a.obj", v + "v 0 0\n"), HasSubstr("z of a vertex is missing"));
    EXPECT_THAT(refused("a.obj", v + "vt nan 0\n"), HasSubstr("u of a texture coordinate"));
    EXPECT_THAT(refused("a.obj", v), HasSubstr("holds no triangles"));
    EXPECT_THAT(refused("a.obj", v + "f 1 1 2\n"), HasSubstr("1 triangle have no area"));
    EXPECT_THAT(refused("a.obj", std::string("v 0 0 0\n\0\0", 10)), HasSubstr("binary data"));
}

TEST_F(PolygonFileTest, TinyAndHugeCoordinatesAreFine) {
    const Scene scene = load("a.obj", "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\n"
                                      "v 1e30 0 0\nv 0 1e30 0\nv 1e-400 0 0\nf 1 2 3\nf 1 4 5\n");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 2u);
    for (const glm::vec3& normal : scene.meshes[0].normals) {
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
}

TEST_F(PolygonFileTest, PlyReadsNormalsUvsAndSkipsElements) {
    const Scene scene =
        load("a.ply",
             "ply\nformat ascii 1.0\nelement camera 1\nproperty float k\nproperty list uchar int "
             "more\nelement vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n"
             "property float x\nproperty float y\nproperty float z\nproperty float s\nproperty "
             "float t\nelement face 1\nproperty list int int vertex_index\nend_header\n"
             "7 2 8 9\n0 0 5 0 0 0 0.25 0.25\n0 0 5 1 0 0 1 0\n0 1 0 0 1 0 0 1\n3 0 1 2\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.25f, 0.75f));
}

TEST_F(PolygonFileTest, PlyReadsUvsOfCorners) {
    const Scene scene = load(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
                 "y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                 "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                 "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 1 0 1\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 5u); // the seam splits one vertex, and only one
    EXPECT_EQ(mesh.uvs[mesh.indices[3]], glm::vec2(0.5f, 1.0f));
}

TEST_F(PolygonFileTest, PlyReadsTriangleStrips) {
    const Scene scene = load(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
                 "y\nproperty float z\nelement tristrips 1\nproperty list int int "
                 "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 2\n");
    EXPECT_EQ(scene.meshes[0].triangleCount(), 3u);
    for (const glm::vec3& normal : scene.meshes[0].normals) {
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
}

TEST_F(PolygonFileTest, PlyMistakesAreNamed) {
    const auto ply = [](const std::string& vertices, const std::string& faces,
                        const std::string& data) {
        return "ply\nformat ascii 1.0\nelement vertex " + vertices +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
               "\nproperty list uchar int vertex_indices\nend_header\n" + data;
    };
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_THAT(refused("a.ply", ply("4000000000", "1", points)),
                HasSubstr("4000000000 of 'vertex' are promised, but only"));
    EXPECT_THAT(refused("a.ply", ply("99999999999999999999999", "1", points)),
                HasSubstr("line 3: the count of an element"));
    EXPECT_THAT(refused("a.ply", ply("-1", "1", points)), HasSubstr("a count of -1"));
    EXPECT_THAT(refused("a.ply", ply("3", "1", points + "3 0 1 3\n")),
                HasSubstr("line 13: vertex index 3 is past the 3 vertices"));
    EXPECT_THAT(refused("a.ply", ply("3", "1", points + "3 0 1 -1\n")),
                HasSubstr("line 13: vertex index -1"));
    EXPECT_THAT(refused("a.ply", ply("3", "1", points + "250 0 1 2\n")),
                HasSubstr("has a length of 250"));
    EXPECT_THAT(refused("a.ply", ply("3", "1", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")),
                HasSubstr("line 11: a coordinate is not finite"));
    EXPECT_THAT(refused("a.ply", ply("3", "1", "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n")),
                HasSubstr("'x' is not a number"));
    EXPECT_THAT(refused("a.ply", "plyx\n"), HasSubstr("does not start with 'ply'"));
    EXPECT_THAT(refused("a.ply", "ply\nformat ascii 2.0\nend_header\n0\n"),
                HasSubstr("PLY version '2.0'"));
    std::string nan = cubePly("binary_little_endian");
    const float notANumber = std::nanf("");
    std::memcpy(nan.data() + nan.find("end_header\n") + 11 + 17 * 5 + 8, &notANumber, 4);
    EXPECT_THAT(refused("a.ply", nan), HasSubstr("vertex 5: a coordinate is not finite"));
}

TEST_F(PolygonFileTest, OffHasPrefixes) {
    const Scene scene =
        load("a.off", "# comment\n\nSTCNOFF 3 1 0\n0 0 0  0 0 2  255 0 0 255  0.5 0.25\n"
                      "1 0 0  0 0 2  0 0\n\n0 1 0  0 0 2  1 1 # last\n3 0 1 2\n");
    EXPECT_EQ(scene.meshes[0].uvs[0], glm::vec2(0.5f, 0.75f));
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
}

TEST_F(PolygonFileTest, OffMistakesAreNamed) {
    EXPECT_THAT(refused("a.off", "4OFF\n1 1 1\n"), HasSubstr("three dimensions"));
    EXPECT_THAT(refused("a.off", "OFF BINARY\n1 1 1\n"), HasSubstr("save it as ascii OFF"));
    EXPECT_THAT(refused("a.off", "PLY\n1 1 1\n"), HasSubstr("starts with 'PLY', not OFF"));
    EXPECT_THAT(refused("a.off", "OFF\n4000000000 1 0\n0 0 0\n"),
                HasSubstr("4000000000 vertices are promised"));
    EXPECT_THAT(refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                HasSubstr("line 6: vertex index 3 is outside 0 ... 2"));
    EXPECT_THAT(refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n"),
                HasSubstr("after 0 of 1 faces"));
    EXPECT_THAT(refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900000000 0 1 2\n"),
                HasSubstr("900000000 corners"));
}

TEST_F(PolygonFileTest, StlMistakesAreNamed) {
    std::string lying = cubeStl(true);
    lying[83] = '\x7f';
    lying[0] = 'S';
    lying[5] = '_';
    EXPECT_THAT(refused("a.stl", lying), HasSubstr("facets are promised"));
    std::string nan = cubeStl(true);
    const float infinity = INFINITY;
    std::memcpy(nan.data() + 84 + 50 * 3 + 12 + 4, &infinity, 4);
    EXPECT_THAT(refused("a.stl", nan), HasSubstr("facet 3: a vertex is not finite"));
    EXPECT_THAT(refused("a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                HasSubstr("'vertex' should follow"));
    EXPECT_THAT(refused("a.stl", "solid x\nendsolid x\n"), HasSubstr("holds no triangles"));
    EXPECT_THAT(refused("a.stl", "hello"), HasSubstr("'facet' or 'endsolid'"));
}

TEST_F(PolygonFileTest, FilesThatAreNoneAreNamed) {
    EXPECT_THAT(refusal(mFolder.path()), HasSubstr("is a folder"));
    EXPECT_THAT(refusal(mFolder.path() / "missing.obj"), HasSubstr("there is no such file"));
    EXPECT_THAT(refused("empty.ply", ""), HasSubstr("is empty"));
    EXPECT_THAT(refused("a.fbx", "x"),
                HasSubstr("convert it to one of .gltf .glb .obj .ply .off .stl"));
    EXPECT_THAT(refused("noextension", "x"), HasSubstr("has no extension"));
    EXPECT_THAT(refusal("/dev/null.obj"), HasSubstr("no such file"));
}

} // namespace

} // namespace celadon
