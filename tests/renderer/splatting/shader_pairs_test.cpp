// Functions that exist in GLSL and in C++ give the same numbers, over grids with their ends and
// ugly values: small compute shaders include the shipped files.
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_blocks.h"
#include "renderer/gpu_materials.h"
#include "renderer/scene/light.h"
#include "renderer/shading/fresnel.h"
#include "subedit/mean_profile.h"
#include "subedit/radius_map.h"
#include "subedit/range_table.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"
#include "tests/support/worlds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace celadon {
namespace {

using shaders::EmbeddedShader;

/// Each evaluates one function on in_[i] into out_[i].
constexpr std::string_view kHead = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer In { vec4 in_[]; };
layout(std430, binding = 1) writeonly buffer Out { vec4 out_[]; };
)";

constexpr std::array kFunctions{
    EmbeddedShader{"pair_fresnel.comp", R"(
#include "pair_head.glsl"
#include "include/fresnel.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < in_.length()) {
        out_[i] = vec4(fresnelTransmittance(in_[i].x, in_[i].y));
    }
})"},
    EmbeddedShader{"pair_spot.comp", R"(
#include "pair_head.glsl"
#include "include/light.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < in_.length()) {
        out_[i] = vec4(spotFactor(in_[i].xyz));
    }
})"},
    EmbeddedShader{"pair_profile.comp", R"(
#include "pair_head.glsl"
#include "include/material.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < in_.length()) {
        int m = int(in_[i].w);
        out_[i] = vec4(logProfile(m, in_[i].xy, in_[i].z), materialRadii(m, in_[i].xy).x);
    }
})"},
    EmbeddedShader{"pair_far_energy.comp", R"(
#include "pair_head.glsl"
#include "include/material.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < in_.length()) {
        out_[i] = vec4(logFarEnergy(int(in_[i].w), in_[i].xy, in_[i].z), 0.0);
    }
})"},
    EmbeddedShader{"pair_tangents.comp", R"(
#include "pair_head.glsl"
#include "include/sphere_bounds.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < in_.length()) {
        out_[i] = vec4(tangentSlopes(in_[i].x, in_[i].y, in_[i].z), 0.0, 0.0);
    }
})"},
    EmbeddedShader{"pair_head.glsl", kHead},
};

/// The shipped files and those above.
std::vector<EmbeddedShader> withShippedFiles() {
    const auto shipped = shaders::embeddedShaders();
    std::vector<EmbeddedShader> files(shipped.begin(), shipped.end());
    files.insert(files.end(), kFunctions.begin(), kFunctions.end());
    std::sort(files.begin(), files.end(),
              [](const EmbeddedShader& a, const EmbeddedShader& b) { return a.path < b.path; });
    return files;
}

class ShaderPairs : public test::GlTest {
protected:
    std::vector<glm::vec4> evaluate(std::string_view shader, const std::vector<glm::vec4>& in,
                                    int materials = 1) {
        const gl::Program program(shader, gl::ShaderLibrary(std::span(mFiles)), {shader},
                                  {{"MATERIAL_COUNT", std::to_string(materials)}});
        const gl::Buffer input = gl::Buffer::of("in", in);
        const gl::Buffer output("out", in.size() * sizeof(glm::vec4));
        program.use();
        input.bindStorage(0);
        output.bindStorage(1);
        glDispatchCompute(static_cast<GLuint>((in.size() + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        return output.read<glm::vec4>();
    }

private:
    std::vector<EmbeddedShader> mFiles = withShippedFiles();
};

TEST_F(ShaderPairs, Fresnel) {
    // No boundary at all (eta 1) is left out: there grazing light passes in C++ and is stopped
    // here.
    std::vector<glm::vec4> in;
    for (const float eta : {0.6f, 0.99f, 1.01f, 1.3f, 1.5f, 2.4f, 10.0f}) {
        for (const float cosine : {-1.0f, -1e-3f, 0.0f, 1e-7f, 1e-3f, 0.999999f, 1.0f, 1.5f}) {
            in.emplace_back(cosine, eta, 0.0f, 0.0f);
        }
        for (int i = 1; i < 100; ++i) {
            in.emplace_back(static_cast<float>(i) / 101.0f, eta, 0.0f,
                            0.0f); // off the critical angle
        }
    }
    const std::vector<glm::vec4> out = evaluate("pair_fresnel.comp", in);
    double worst = 0.0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const double expected =
            fresnelTransmittance(static_cast<double>(in[i].x), static_cast<double>(in[i].y));
        worst = std::max(worst, std::abs(static_cast<double>(out[i].x) - expected));
        EXPECT_NEAR(static_cast<double>(out[i].x), expected, test::kSameFormula)
            << "cosine " << in[i].x << ", eta " << in[i].y;
    }
    fmt::print("[ measured ] fresnelTransmittance: {:.2g}\n", worst);
}

TEST_F(ShaderPairs, SpotFactor) {
    double worst = 0.0;
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (const auto& [inner, outer] : {std::pair(0.0, 45.0), std::pair(20.0, 30.0),
                                       std::pair(0.0, 90.0), std::pair(29.0, 30.0)}) {
        Light light;
        light.kind = Light::Kind::Spot;
        light.direction = glm::normalize(glm::dvec3(0.3, -0.9, 0.2));
        light.innerConeRadians = inner * kDegree;
        light.outerConeRadians = outer * kDegree;
        blocks::LightBlock block{};
        block.direction = glm::vec4(glm::vec3(light.direction), 0.0f);
        block.color.w = 1.0f;
        block.cone = glm::vec4(static_cast<float>(std::cos(light.innerConeRadians)),
                               static_cast<float>(std::cos(light.outerConeRadians)), 0.0f, 0.0f);
        const gl::Buffer uniforms = gl::Buffer::of("light", std::array{block});
        uniforms.bindUniform(blocks::kLight);
        const glm::dvec3 side = glm::normalize(glm::cross(light.direction, glm::dvec3(0, 0, 1)));
        std::vector<glm::vec4> in;
        std::vector<double> angles;
        for (double degrees = 0.0; degrees <= 180.0; degrees += 0.75) {
            const glm::dvec3 ray =
                std::cos(degrees * kDegree) * light.direction + std::sin(degrees * kDegree) * side;
            in.emplace_back(glm::vec3(-ray), 0.0f);
            angles.push_back(std::cos(degrees * kDegree));
        }
        const std::vector<glm::vec4> out = evaluate("pair_spot.comp", in);
        // Cosines are rounded to 6e-8, and the ramp between the cones may be narrow.
        const double ramp = std::cos(light.innerConeRadians) - std::cos(light.outerConeRadians);
        const double tolerance = test::kSameFormula + 2.0 * 2e-7 / ramp;
        for (std::size_t i = 0; i < in.size(); ++i) {
            const double expected = spotFactor(light, angles[i]);
            worst = std::max(worst, std::abs(static_cast<double>(out[i].x) - expected));
            EXPECT_NEAR(static_cast<double>(out[i].x), expected, tolerance)
                << inner << " " << outer << ", cosine " << angles[i];
        }
    }
    fmt::print("[ measured ] spotFactor: {:.2g}\n", worst);
}

/// ln P of a map at (uv, r) in C++: bilinear over the texture, linear between knots.
glm::dvec3 logProfileAt(const subedit::MaterialMap& map, glm::vec2 uv, double r) {
    std::vector<float> knots(static_cast<std::size_t>(map.knots()) * 3);
    map.sampleLogProfile(uv, knots.data());
    const double x = std::min(r / static_cast<double>(map.maxRadiusMm), 1.0) * map.segments;
    const std::size_t k =
        std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(map.segments - 1));
    const double t = x - static_cast<double>(k);
    glm::dvec3 value;
    for (std::size_t c = 0; c < 3; ++c) {
        value[static_cast<int>(c)] = (1.0 - t) * static_cast<double>(knots[3 * k + c]) +
                                     t * static_cast<double>(knots[3 * (k + 1) + c]);
    }
    return value;
}

/// Texels that differ by up to 6, filtered with weights of 8 bits as GPUs have; llvmpipe's are of
/// full precision (1e-5 measured).
constexpr double kLogProfileTolerance = 0.03;

TEST_F(ShaderPairs, LogProfileAndRadius) {
    for (const MaterialPointer& material :
         {test::chessboardMaterial(), test::mediumRangeMaterial()}) {
        const GpuMaterials materials(std::array{material}, 0.99, 0.01, ExitFresnel::Exact);
        materials.bind();
        std::vector<glm::vec4> in;
        const float r_s = material->maxRadiusMm;
        for (const float u : {0.0f, 1.0f, 0.5f, 0.015f, 0.37f, 0.1234f, 0.99f, -0.2f, 2.61f}) {
            for (const float v : {0.0f, 0.013f, 0.31f, 0.4375f, 0.77f, 1.0f, -1.3f}) {
                for (const float r : {0.0f, 0.01f, 0.3f, 0.77f, 0.999f, 1.0f, 1.2f}) {
                    in.emplace_back(u, v, r * r_s, 0.0f);
                }
            }
        }
        const std::vector<glm::vec4> out = evaluate("pair_profile.comp", in);
        double worst = 0.0;
        for (std::size_t i = 0; i < in.size(); ++i) {
            const glm::dvec3 expected =
                logProfileAt(*material, glm::vec2(in[i]), static_cast<double>(in[i].z));
            for (int c = 0; c < 3; ++c) {
                const double tolerance = kLogProfileTolerance;
                const double error = std::abs(static_cast<double>(out[i][c]) - expected[c]);
                worst = std::max(worst, error);
                EXPECT_LE(error, tolerance)
                    << "uv " << in[i].x << " " << in[i].y << ", r " << in[i].z << ", channel " << c;
            }
            EXPECT_GT(out[i].w, 0.0f);
        }
        fmt::print("[ measured ] logProfile of {}: {:.2g} in ln P\n", material->name, worst);
        // At texel centers R_P is that of the texel.
        const std::vector<float> radii = subedit::effectiveRadiusMap(*material);
        std::vector<glm::vec4> centers;
        for (int y = 0; y < material->height; ++y) {
            for (int x = 0; x < material->width; ++x) {
                centers.emplace_back(
                    (static_cast<float>(x) + 0.5f) / static_cast<float>(material->width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(material->height), 0.0f,
                    0.0f);
            }
        }
        const std::vector<glm::vec4> atCenters = evaluate("pair_profile.comp", centers);
        for (std::size_t i = 0; i < radii.size(); ++i) {
            EXPECT_NEAR(atCenters[i].w, radii[i], 2e-3f * radii[i]);
        }
    }
}

/// Many materials, no two of one size and one number of knots, in one array: each is read as it is
/// alone, across its repeating border as well, and stays so while parts of it are edited.
TEST_F(ShaderPairs, ManyMaterialsBesideOneAnother) {
    constexpr int kCount = 23;
    std::vector<MaterialPointer> maps;
    for (int i = 0; i < kCount; ++i) {
        const auto map = std::make_shared<subedit::MaterialMap>(*test::makeMaterial(
            "material " + std::to_string(i), 1 + (i * 5) % 17, 8 + (i * 7) % 40, 5.0f + float(i),
            [&](int x, int y) {
                return test::ProfileRecipe{
                    {0.8, 0.5, 0.3}, glm::dvec3(0.4 + 0.05 * i + 0.02 * x + 0.03 * ((y * 7) % 5))};
            }));
        if (i % 3 == 2 && map->width % 2 == 0) { // not square
            map->width /= 2;
            map->height *= 2;
        }
        maps.push_back(map);
    }
    GpuMaterials materials(maps, 0.99, 0.01, ExitFresnel::Exact);
    const auto expectSameFarEnergies = [&](std::span<const float> radii) {
        const FarEnergies::Selection energies = materials.selectFarEnergies(radii);
        std::vector<glm::vec4> in;
        for (int m = 0; m < kCount; ++m) {
            for (const float u : {0.0f, 1.0f, 0.003f, 0.61f, 0.998f, -3.2f}) {
                for (const float v : {0.0f, 0.004f, 0.43f, 0.995f, 7.7f}) {
                    for (const float r : radii) {
                        in.emplace_back(u, v, r, float(m));
                    }
                }
            }
        }
        const std::vector<glm::vec4> out = evaluate("pair_far_energy.comp", in, kCount);
        for (std::size_t i = 0; i < in.size(); ++i) {
            const Four found = energies.at(i % radii.size(), int(in[i].w), glm::vec2(in[i]));
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(found[c], out[i][c], 1e-4f * std::max(1.0f, std::abs(out[i][c])))
                    << "material " << in[i].w << ", uv " << in[i].x << " " << in[i].y << ", r "
                    << in[i].z;
            }
        }
    };
    const auto expectSame = [&] {
        materials.bind();
        std::vector<glm::vec4> in;
        for (int m = 0; m < kCount; ++m) {
            for (const float u : {0.0f, 1.0f, 0.003f, 0.61f, 0.998f, -3.2f}) {
                for (const float v : {0.0f, 0.004f, 0.43f, 0.995f, 7.7f}) {
                    for (const float r : {0.0f, 0.13f, 0.7f, 1.0f, 1.1f}) {
                        const float r_s = maps[static_cast<std::size_t>(m)]->maxRadiusMm;
                        in.emplace_back(u, v, r * r_s, float(m));
                    }
                }
            }
        }
        const std::vector<glm::vec4> out = evaluate("pair_profile.comp", in, kCount);
        for (std::size_t i = 0; i < in.size(); ++i) {
            const auto& map = *maps[static_cast<std::size_t>(in[i].w)];
            const glm::dvec3 expected =
                logProfileAt(map, glm::vec2(in[i]), static_cast<double>(in[i].z));
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(static_cast<double>(out[i][c]), expected[c], kLogProfileTolerance)
                    << "material " << in[i].w << ", uv " << in[i].x << " " << in[i].y << ", r "
                    << in[i].z;
            }
        }
    };
    expectSame();
    constexpr std::array kRadii{0.0f, 0.7f, 4.0f, 20.0f};
    expectSameFarEnergies(kRadii);
    for (int m = 0; m < kCount; ++m) {
        auto map = std::make_shared<subedit::MaterialMap>(*maps[static_cast<std::size_t>(m)]);
        // A rectangle that touches the right and the lower rim, or all of a small map.
        const subedit::TexelRect rect{map->width / 3, map->height / 2, map->width - map->width / 3,
                                      map->height - map->height / 2};
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                for (int i = 0; i < 3 * map->knots(); ++i) {
                    map->logProfile[map->index(x, y, 0) + static_cast<std::size_t>(i)] -= 1.5f;
                }
            }
        }
        materials.update(m, *map, rect);
        maps[static_cast<std::size_t>(m)] = map;
    }
    expectSame();
    expectSameFarEnergies(kRadii);
    expectSameFarEnergies(std::array{0.0f, 2.1f, 9.0f, 13.0f});
}

/// Large maps are made in parts, between which it can end.
TEST_F(ShaderPairs, MaterialsTellHowFarTheyAre) {
    const MaterialPointer large = test::makeMaterial("large", 256, 8, 5.0f, [](int x, int) {
        return test::ProfileRecipe{glm::dvec3(0.5), glm::dvec3(0.4 + 0.001 * x)};
    });
    const std::array maps{test::chessboardMaterial(), large};
    std::vector<float> told;
    const GpuMaterials materials(maps, 0.99, 0.01, ExitFresnel::Exact,
                                 [&](float done) { told.push_back(done); });
    EXPECT_GE(told.size(), 3u);
    EXPECT_TRUE(std::ranges::is_sorted(told));
    EXPECT_EQ(told.front(), 0.0f);
    EXPECT_LT(told.back(), 1.0f);
    struct Enough {};
    EXPECT_THROW(GpuMaterials(maps, 0.99, 0.01, ExitFresnel::Exact,
                              [](float done) {
                                  if (done > 0.0f) {
                                      throw Enough();
                                  }
                              }),
                 Enough);
}

TEST_F(ShaderPairs, MaterialsKnowWhetherTheyHaveRoom) {
    GLint side = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    EXPECT_TRUE(GpuMaterials::hasRoom(std::array{glm::ivec3(64, 64, 49), glm::ivec3(1, 1, 257)}));
    EXPECT_FALSE(GpuMaterials::hasRoom(std::array{glm::ivec3(side, 1, 49)})); // with its border
    if (context().isSoftware()) { // within its limits, and 300 gigabytes
        EXPECT_FALSE(GpuMaterials::hasRoom(std::array{glm::ivec3(side - 2, side - 2, 257)}));
    }
}

TEST_F(ShaderPairs, RangeTable) {
    const MaterialPointer material = test::chessboardMaterial();
    const GpuMaterials materials(std::array{material}, 0.99, 0.01, ExitFresnel::Exact);
    const auto table = subedit::RangeTable::build(
        subedit::meanProfile(*material, subedit::effectiveRadiusMap(*material)), 0.01);
    for (double T = 0.5; T < 10000.0; T *= 1.07) {
        EXPECT_NEAR(materials.minimalRadius(static_cast<float>(T)),
                    table.minimalRadius(static_cast<float>(T)), 1e-5)
            << T;
    }
}

TEST_F(ShaderPairs, TangentSlopesBoundTheSphereTightly) {
    std::vector<glm::vec4> in;
    for (const float a : {-30.0f, -3.0f, -0.5f, 0.0f, 1e-4f, 0.7f, 2.0f, 40.0f}) {
        for (const float z : {-2.0f, 0.5f, 1.0f, 3.0f, 10.0f}) {
            for (const float r : {0.01f, 0.3f, 0.95f, 1.5f, 2.5f}) {
                in.emplace_back(a, z, r, 0.0f);
            }
        }
    }
    const std::vector<glm::vec4> out = evaluate("pair_tangents.comp", in);
    constexpr int kPoints = 200000;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const double a = static_cast<double>(in[i].x);
        const double z = static_cast<double>(in[i].y);
        const double r = static_cast<double>(in[i].z);
        const double low = static_cast<double>(out[i].x);
        const double high = static_cast<double>(out[i].y);
        if (z + r <= 0.0) {
            continue; // wholly behind the eye: callers reject it before
        }
        SCOPED_TRACE(fmt::format("a {} z {} r {}: {} {}", a, z, r, low, high));
        // What an axis sees of the sphere is its great circle in the plane of that axis and depth.
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        bool behind = false;
        for (int k = 0; k < kPoints; ++k) {
            const double phi = 2.0 * std::numbers::pi * k / kPoints;
            const double depth = z + r * std::sin(phi);
            if (depth <= 0.0) {
                behind = true;
                continue;
            }
            const double slope = (a + r * std::cos(phi)) / depth;
            least = std::min(least, slope);
            most = std::max(most, slope);
        }
        const double slack = 1e-4 * (1.0 + std::max(std::abs(least), std::abs(most)));
        if (least > -1e4) {
            EXPECT_LE(low, least + slack);
        }
        if (most < 1e4) {
            EXPECT_GE(high, most - slack);
        }
        if (!behind) {
            const double tight = 1e-3 * (1.0 + std::max(std::abs(least), std::abs(most)));
            EXPECT_NEAR(low, least, tight);
            EXPECT_NEAR(high, most, tight);
        }
    }
}

TEST_F(ShaderPairs, SurfacesCompileWithEveryDefineOfAScene) {
    for (const std::vector<gl::ShaderDefine>& scene :
         {std::vector<gl::ShaderDefine>{},
          {{"CUT_OUT", "1"}},
          {{"VERTEX_COLORS", "1"}},
          {{"CUT_OUT", "1"}, {"VERTEX_COLORS", "1"}}}) {
        gl::ShaderLibrary library{std::span(shaders::embeddedShaders())};
        library.define(scene);
        const gl::ShaderDefine count{"MATERIAL_COUNT", "2"};
        const gl::ShaderDefine camera{"CAMERA", "1"};
        const gl::ShaderDefine patch{"PATCH_VARIANCE", "1.0"};
        EXPECT_NO_THROW(gl::Program("light", library, {"surface.vert", "irradiance_buffer.frag"},
                                    {count, patch}));
        EXPECT_NO_THROW(gl::Program("shadow", library, {"surface.vert", "shadow_map.frag"}));
        EXPECT_NO_THROW(gl::Program("view", library, {"surface.vert", "splatting_buffer.frag"},
                                    {count, camera}));
        EXPECT_NO_THROW(gl::Program("coverage", library, {"surface.vert", "splatting_buffer.frag"},
                                    {camera, {"COVERAGE", "1"}}));
    }
}

TEST_F(ShaderPairs, ProgramsCompileForEveryNumberOfMaterials) {
    const gl::ShaderLibrary library{std::span(shaders::embeddedShaders())};
    for (const char* const count : {"1", "2", "40"}) {
        SCOPED_TRACE(count);
        const std::vector<gl::ShaderDefine> base{{"MATERIAL_COUNT", count}};
        auto light = base;
        light.push_back({"PATCH_VARIANCE", "1.0"});
        auto camera = base;
        camera.push_back({"CAMERA", "1"});
        auto leaf = base;
        leaf.push_back({"LEAF", "1"});
        EXPECT_NO_THROW(
            gl::Program("light", library, {"surface.vert", "irradiance_buffer.frag"}, light));
        EXPECT_NO_THROW(
            gl::Program("view", library, {"surface.vert", "splatting_buffer.frag"}, camera));
        EXPECT_NO_THROW(gl::Program("node profile", library, {"node_profile.comp"}, base));
        EXPECT_NO_THROW(gl::Program("accumulation", library, {"accumulation.comp"}, base));
        EXPECT_NO_THROW(gl::Program("shading", library, {"shading.comp"}, base));
        for (const auto& defines : {base, leaf}) {
            EXPECT_NO_THROW(gl::Program(
                "splat", library, {"raster_splat.vert", "raster_splat.geom", "raster_splat.frag"},
                defines));
        }
    }
    EXPECT_NO_THROW(gl::Program("homogeneous splat", library,
                                {"raster_splat.vert", "raster_splat.geom", "raster_splat.frag"},
                                {{"MATERIAL_COUNT", "1"}, {"HOMOGENEOUS", "1"}, {"LEAF", "1"}}));
    for (const std::vector<gl::ShaderDefine>& options :
         {std::vector<gl::ShaderDefine>{},
          {{"KNOTS", "33"}},
          {{"HOMOGENEOUS", "1"}},
          {{"KNOTS", "33"}, {"HOMOGENEOUS", "1"}},
          {{"KNOTS", "33"}, {"HIERARCHICAL", "1"}}}) {
        std::vector<gl::ShaderDefine> defines = options;
        defines.insert(defines.end(), {{"SLICES", "4"}, {"BATCH", "16"}});
        EXPECT_NO_THROW(gl::Program("tile gather", library, {"tile_gather.comp"}, defines));
    }
}

} // namespace
} // namespace celadon
