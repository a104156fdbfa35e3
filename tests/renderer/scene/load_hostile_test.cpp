#include "load_support.h"
#include "renderer/scene/load_gltf.h"
#include "renderer/scene/load_obj.h"
#include "renderer/scene/load_off.h"
#include "renderer/scene/load_ply.h"
#include "renderer/scene/load_stl.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <random>

/// Damaged and hostile files: cut short, with flipped bytes, with lines and numbers exchanged. Each
/// must be read or refused with one line, quickly, and without memory that the file cannot justify.

namespace {

std::atomic<std::size_t> largestAllocation{0};

void* countedAllocation(std::size_t size) {
    std::size_t seen = largestAllocation.load();
    while (size > seen && !largestAllocation.compare_exchange_weak(seen, size)) {
    }
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}

} // namespace

void* operator new(std::size_t size) {
    return countedAllocation(size);
}
void* operator new[](std::size_t size) {
    return countedAllocation(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace celadon {

namespace {

using loadtest::bytesOf;
using loadtest::GltfBuilder;
using loadtest::TemporaryFolder;

using Loader = Scene (*)(const std::filesystem::path&, std::string_view);

struct Seed {
    const char* name;
    Loader load;
    std::string content;
    bool isText;
};

/// A wavy grid of 6 x 6 points, enough structure for damage to matter.
std::vector<glm::vec3> gridPoints() {
    std::vector<glm::vec3> points;
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            points.emplace_back(x, y, 0.125f * static_cast<float>((x * y) % 5));
        }
    }
    return points;
}

template<typename Visit>
void forEachQuad(const Visit& visit) {
    for (std::uint32_t y = 0; y < 5; ++y) {
        for (std::uint32_t x = 0; x < 5; ++x) {
            const std::uint32_t i = 6 * y + x;
            visit(std::array{i, i + 1, i + 7, i + 6});
        }
    }
}

std::string wordsOf(const glm::vec3& p) {
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
}

std::string gridObj() {
    std::string text;
    for (const glm::vec3& p : gridPoints()) {
        text += "v " + wordsOf(p) + "\nvt " + std::to_string(p.x / 5) + " " +
                std::to_string(p.y / 5) + "\n";
    }
    text += "vn 0 0 1\n";
    forEachQuad([&](const auto& quad) {
        text += "f";
        for (const std::uint32_t i : quad) {
            text += " " + std::to_string(i + 1) + "/" + std::to_string(i + 1) + "/1";
        }
        text += "\n";
    });
    return text;
}

std::string gridOff() {
    std::string text = "OFF\n36 25 0\n";
    for (const glm::vec3& p : gridPoints()) {
        text += wordsOf(p) + "\n";
    }
    forEachQuad([&](const auto& q) {
        text += "4 " + std::to_string(q[0]) + " " + std::to_string(q[1]) + " " +
                std::to_string(q[2]) + " " + std::to_string(q[3]) + "\n";
    });
    return text;
}

std::string gridPly(bool binary) {
    std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                       " 1.0\nelement vertex 36\nproperty float x\nproperty float y\nproperty "
                       "float z\nelement face 25\nproperty list uchar int vertex_indices\n"
                       "end_header\n";
    for (const glm::vec3& p : gridPoints()) {
        text += binary ? bytesOf(p.x) + bytesOf(p.y) + bytesOf(p.z) : wordsOf(p) + "\n";
    }
    forEachQuad([&](const auto& quad) {
        text += binary ? "\x04" : "4";
        for (const std::uint32_t i : quad) {
            text += binary ? bytesOf(i) : " " + std::to_string(i);
        }
        text += binary ? "" : "\n";
    });
    return text;
}

std::string gridStl(bool binary) {
    const std::vector<glm::vec3> points = gridPoints();
    std::string facets;
    std::uint32_t count = 0;
    forEachQuad([&](const auto& quad) {
        for (const auto& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            facets += binary ? std::string(12, '\0') : "facet normal 0 0 1\nouter loop\n";
            for (const int k : triangle) {
                const glm::vec3& p = points[quad[static_cast<std::size_t>(k)]];
                facets += binary ? bytesOf(p.x) + bytesOf(p.y) + bytesOf(p.z)
                                 : "vertex " + wordsOf(p) + "\n";
            }
            facets += binary ? std::string(2, '\0') : "endloop\nendfacet\n";
            ++count;
        }
    });
    return binary ? std::string(80, ' ') + bytesOf(count) + facets
                  : "solid grid\n" + facets + "endsolid grid\n";
}

GltfBuilder gridGltf() {
    GltfBuilder gltf;
    std::vector<float> positions;
    std::vector<float> uvs;
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (const glm::vec3& p : gridPoints()) {
        positions.insert(positions.end(), {p.x, p.y, p.z});
        uvs.insert(uvs.end(), {p.x / 5, p.y / 5});
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), {0.5f, 0.5f, 0, 0});
    }
    std::vector<std::uint16_t> indices;
    forEachQuad([&](const auto& q) {
        for (const std::size_t k : {0, 1, 2, 0, 2, 3}) {
            indices.push_back(static_cast<std::uint16_t>(q[k]));
        }
    });
    const int position = gltf.addFloats(positions, "VEC3");
    const int uv = gltf.addFloats(uvs, "VEC2");
    const int index = gltf.addIndices(indices);
    const int joint = gltf.addAccessor(gltf.addView(bytesOf(joints)), "VEC4", 5121, 36);
    const int weight = gltf.addFloats(weights, "VEC4");
    const int sparseIndices = gltf.addView(bytesOf(std::vector<std::uint16_t>{3, 5}));
    const int sparseValues = gltf.addView(bytesOf(std::vector<float>{1, 0, 2, 0, 0, 2}));
    nlohmann::json change{{"type", "VEC3"}, {"componentType", 5126}, {"count", 36}};
    change["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", sparseIndices}, {"componentType", 5123}}},
                        {"values", {{"bufferView", sparseValues}}}};
    gltf.json["accessors"].push_back(change);
    gltf.json["meshes"] = {{{"weights", {0.5}},
                            {"primitives",
                             {{{"attributes",
                                {{"POSITION", position},
                                 {"TEXCOORD_0", uv},
                                 {"JOINTS_0", joint},
                                 {"WEIGHTS_0", weight}}},
                               {"indices", index},
                               {"material", 0},
                               {"targets", {{{"POSITION", 5}}}}}}}}};
    gltf.json["skins"] = {{{"joints", {1, 2}}}};
    gltf.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.1}}}}};
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}}}}};
    gltf.json["nodes"] = {
        {{"mesh", 0}, {"skin", 0}},
        {{"children", {2}}, {"scale", {-1, 1, 1}}, {"camera", 0}},
        {{"translation", {0, 0, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}},
                               {"extras", {{"subedit", "jade.subedit.exr"}}}}};
    return gltf;
}

std::string gridGltfText() {
    const GltfBuilder gltf = gridGltf();
    nlohmann::json document = gltf.finished();
    std::string uri = "data:application/octet-stream,";
    for (const char c : gltf.binary) {
        constexpr const char* kHex = "0123456789abcdef";
        const auto byte = static_cast<unsigned char>(c);
        uri += std::string("%") + kHex[byte >> 4] + kHex[byte & 15];
    }
    document["buffers"][0]["uri"] = uri;
    return document.dump(1);
}

class HostileTest : public testing::TestWithParam<Seed> {
protected:
    int mRead = 0;
    int mRefused = 0;
    std::string mMessage;

    /// Reads or refuses; anything else ends the test.
    void attempt(const std::string& content, const std::string& what) {
        const std::filesystem::path file = GetParam().name; // no disk: there are many variants
        largestAllocation = 0;
        const auto start = std::chrono::steady_clock::now();
        try {
            const Scene scene = GetParam().load(file, content);
            ++mRead;
            ASSERT_FALSE(scene.meshes.empty()) << what;
            for (const Mesh& mesh : scene.meshes) {
                ASSERT_FALSE(mesh.indices.empty()) << what;
                ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << what;
                for (const std::uint32_t index : mesh.indices) {
                    ASSERT_LT(index, mesh.positions.size()) << what;
                }
                for (const glm::vec3& normal : mesh.normals) {
                    ASSERT_NEAR(glm::length(normal), 1.0f, 1e-4f) << what;
                }
            }
        } catch (const InputError& error) {
            ++mRefused;
            const std::string message = mMessage = error.what();
            ASSERT_EQ(message.find('\n'), std::string::npos) << what << ": " << message;
            ASSERT_EQ(message.rfind("'" + file.string() + "'", 0), 0u) << what << ": " << message;
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        ASSERT_LT(seconds.count(), 5.0) << what;
        ASSERT_LT(largestAllocation.load(), 64 * content.size() + 200000) << what;
    }
};

TEST_P(HostileTest, SeedIsRead) {
    attempt(GetParam().content, "seed");
    EXPECT_EQ(mRead, 1) << mMessage;
}

TEST_P(HostileTest, CutShortItIsRefused) {
    const std::string& whole = GetParam().content;
    testing::internal::CaptureStderr();
    for (std::size_t eighth = 1; eighth < 8; ++eighth) {
        attempt(whole.substr(0, whole.size() * eighth / 8), "cut at " + std::to_string(eighth));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    // An OBJ has no counts: what ends between two faces is whole.
    if (std::string_view(GetParam().name) != "seed.obj") {
        EXPECT_EQ(mRead, 0);
    }
}

TEST_P(HostileTest, FlippedBytesDoNoHarm) {
    std::mt19937 random(20091);
    testing::internal::CaptureStderr();
    for (int variant = 0; variant < 400 && !HasFatalFailure(); ++variant) {
        std::string content = GetParam().content;
        const int flips = 1 + static_cast<int>(random() % 4);
        for (int k = 0; k < flips; ++k) {
            // Half of the flips hit the first part, where headers and counts are.
            const std::size_t within =
                random() % 2 == 0 ? std::min<std::size_t>(content.size(), 400) : content.size();
            content[random() % within] = static_cast<char>(random());
        }
        attempt(content, "variant " + std::to_string(variant));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_GT(mRefused, 0);
}

TEST_P(HostileTest, ExchangedNumbersDoNoHarm) {
    static const std::vector<std::string> kNumbers{
        "-1",   "0",    "1",          "255", "65536", "4000000000", "4294967295",
        "1e39", "-1e9", "2147483647", "nan", "inf",   "0x10",       "18446744073709551616",
        "",     "1.5",  "[]",         "{}",  "null",  "\"\"",       "-9223372036854775808"};
    std::mt19937 random(7);
    for (int variant = 0; variant < 400 && GetParam().isText && !HasFatalFailure(); ++variant) {
        std::string content = GetParam().content;
        // JSON keeps its data at one place: only the numbers elsewhere are worth a try.
        const std::size_t data = content.find("%");
        std::size_t at = random() % content.size();
        at = at >= data ? random() % 400 : at;
        at = content.find_first_of("0123456789", at);
        if (at == std::string::npos) {
            continue;
        }
        const std::size_t end = content.find_first_not_of("0123456789.-+e", at);
        content.replace(at, end == std::string::npos ? 1 : end - at,
                        kNumbers[random() % kNumbers.size()]);
        attempt(content, "variant " + std::to_string(variant));
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, HostileTest,
                         testing::Values(Seed{"seed.obj", loaders::loadObj, gridObj(), true},
                                         Seed{"seed.off", loaders::loadOff, gridOff(), true},
                                         Seed{"ascii.ply", loaders::loadPly, gridPly(false), true},
                                         Seed{"binary.ply", loaders::loadPly, gridPly(true), false},
                                         Seed{"ascii.stl", loaders::loadStl, gridStl(false), true},
                                         Seed{"binary.stl", loaders::loadStl, gridStl(true), false},
                                         Seed{"seed.gltf", loaders::loadGltf, gridGltfText(), true},
                                         Seed{"seed.glb", loaders::loadGltf, gridGltf().glb(),
                                              false}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(Hostile, ManyEqualThingsStayLinear) {
    // Hash tables and searches must not degrade: many NaN normals, one vertex with many UVs, a
    // polygon of many corners.
    const TemporaryFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 1; i <= 20000; ++i) {
        const std::string n = std::to_string(i);
        text += "vn nan nan nan\nvt 0." + n + " 0\nf 1/" + n + "/" + n + " 2/" + n + "/" + n +
                " 3/" + n + "/" + n + "\n";
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(loadScene(folder.write("a.obj", text)).meshes[0].triangleCount(), 20000u);
    std::string polygon = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 300000; ++i) {
        polygon += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
    }
    try {
        (void)loadScene(folder.write("b.obj", polygon));
    } catch (const InputError&) {
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 10.0);
}

} // namespace

} // namespace celadon
