// The environment in highlights: the two halves of the split sum against the lobe itself, light
// neither lost nor made, and the same picture as many lights give.
#include "renderer/gl/buffer.h"
#include "renderer/shading/environment_reflection.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace celadon {
namespace {

using shaders::EmbeddedShader;

/// The lobe over the hemisphere by midpoints: the albedo that the table is to hold.
constexpr std::array kFiles{EmbeddedShader{"quadrature.comp", R"(
#include "include/ggx.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer In { vec4 in_[]; }; // n.v, roughness, f0
layout(std430, binding = 1) writeonly buffer Out { vec4 out_[]; };
void main() {
    vec4 q = in_[gl_GlobalInvocationID.x];
    vec3 v = vec3(sqrt(1.0 - q.x * q.x), 0.0, q.x);
    vec3 sum = vec3(0.0);
    const int N = 700;
    for (int i = 0; i < N; ++i) {
        float sine = (float(i) + 0.5) / float(N); // d omega = sine / cosine d sine d phi
        float cosine = sqrt(1.0 - sine * sine);
        for (int j = 0; j < N; ++j) {
            float phi = 3.14159265 * (float(j) + 0.5) / float(N);
            vec3 l = vec3(sine * cos(phi), sine * sin(phi), cosine);
            sum += ggxLobe(vec3(0.0, 0.0, 1.0), v, l, q.y, vec3(q.z)) * sine / cosine;
        }
    }
    out_[gl_GlobalInvocationID.x] = vec4(sum * 2.0 * 3.14159265 / float(N * N), 0.0);
})"}};

EnvironmentMap map(int width, glm::vec3 radiance) {
    EnvironmentMap result;
    result.width = width;
    result.height = width / 2;
    result.radiance.assign(static_cast<std::size_t>(width * width / 2), radiance);
    return result;
}

/// Grey, with a sun of a few texels that brings several times what the rest does.
EnvironmentMap sunnyMap() {
    EnvironmentMap result = map(256, {0.2f, 0.3f, 0.4f});
    for (int y = 40; y < 43; ++y) {
        for (int x = 70; x < 73; ++x) {
            result.radiance[static_cast<std::size_t>(y * 256 + x)] = {9000.0f, 7000.0f, 4000.0f};
        }
    }
    return result;
}

class Reflection : public test::GlTest {
protected:
    gl::ShaderLibrary mShaders{std::span(shaders::embeddedShaders())};
};

TEST_F(Reflection, AlbedoIsTheIntegralOfTheLobe) {
    auto files = std::vector(shaders::embeddedShaders().begin(), shaders::embeddedShaders().end());
    files.insert(files.end(), kFiles.begin(), kFiles.end());
    std::sort(files.begin(), files.end(),
              [](const EmbeddedShader& a, const EmbeddedShader& b) { return a.path < b.path; });
    std::vector<glm::vec4> in;
    std::vector<glm::ivec2> texels;
    for (const int y : {25, 40, 63}) { // roughness 0.4 and up: what midpoints resolve
        for (const int x : {3, 12, 31, 63}) {
            texels.emplace_back(x, y);
            in.emplace_back((float(x) + 0.5f) / 64.0f, (float(y) + 0.5f) / 64.0f, 0.04f, 0.0f);
        }
    }
    const gl::Program program("quadrature", gl::ShaderLibrary(std::span(files)),
                              {"quadrature.comp"});
    const gl::Buffer input = gl::Buffer::of("in", in);
    const gl::Buffer output("out", in.size() * sizeof(glm::vec4));
    program.use();
    input.bindStorage(0);
    output.bindStorage(1);
    glDispatchCompute(static_cast<GLuint>(in.size()), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const auto expected = output.read<glm::vec4>();
    const EnvironmentReflection reflection(mShaders, map(32, glm::vec3(1.0f)));
    const std::vector<float> table = reflection.albedos().readLevel(0);
    for (std::size_t i = 0; i < in.size(); ++i) {
        const std::size_t at = 2 * static_cast<std::size_t>(texels[i].y * 64 + texels[i].x);
        const double albedo = static_cast<double>(table[at] * in[i].z + table[at + 1]);
        EXPECT_NEAR(albedo, static_cast<double>(expected[i].x),
                    0.02 * static_cast<double>(expected[i].x))
            << "n.v " << in[i].x << ", roughness " << in[i].y;
    }
}

TEST_F(Reflection, AConstantMapIsConstantUnderEveryLobe) {
    const EnvironmentReflection reflection(mShaders, map(64, {0.5f, 1.0f, 2.0f}));
    for (int level = 0; level < reflection.lobes().levels(); ++level) {
        const std::vector<float> texels = reflection.lobes().readLevel(level);
        for (std::size_t i = 0; i < texels.size(); i += 4) {
            ASSERT_NEAR(texels[i], 0.5f, 1e-4f);
            ASSERT_NEAR(texels[i + 1], 1.0f, 1e-4f);
            ASSERT_NEAR(texels[i + 2], 2.0f, 2e-4f);
        }
    }
}

/// A lobe spreads light and keeps it: the mean over all directions stays. And a sun of a few texels
/// is a smooth spot, not a swarm of copies.
TEST_F(Reflection, ASunKeepsItsLightAndLeavesNoSparkle) {
    const EnvironmentMap source = sunnyMap();
    glm::dvec3 mean(0.0);
    for (const Light& light : environmentLights(source, 8)) {
        mean += light.color / (4.0 * M_PI);
    }
    const EnvironmentReflection reflection(mShaders, source);
    for (int level = 0; level < reflection.lobes().levels(); ++level) {
        const int edge = reflection.lobes().edge(level);
        const std::vector<float> texels = reflection.lobes().readLevel(level);
        double sum = 0.0;
        double weights = 0.0;
        int peaks = 0;
        const auto at = [&](int face, int y, int x) {
            return static_cast<double>(
                texels[4 * static_cast<std::size_t>((face * edge + y) * edge + x)]);
        };
        for (int face = 0; face < 6; ++face) {
            for (int y = 0; y < edge; ++y) {
                for (int x = 0; x < edge; ++x) {
                    const double s = (x + 0.5) / edge * 2.0 - 1.0;
                    const double t = (y + 0.5) / edge * 2.0 - 1.0;
                    const double weight = std::pow(1.0 + s * s + t * t, -1.5);
                    sum += weight * at(face, y, x);
                    weights += weight;
                    const bool inside = x > 0 && y > 0 && x + 1 < edge && y + 1 < edge;
                    if (inside && level >= 2 && at(face, y, x) > 0.5) {
                        bool highest = true;
                        for (int k = 0; k < 9; ++k) {
                            highest &= k == 4 || at(face, y, x) >
                                                     1.02 * at(face, y + k / 3 - 1, x + k % 3 - 1);
                        }
                        peaks += highest ? 1 : 0;
                    }
                }
            }
        }
        fmt::print("[ measured ] level {}: mean {:.4f} of {:.4f}, {} peaks\n", level, sum / weights,
                   mean.x, peaks);
        EXPECT_NEAR(sum / weights, mean.x, 0.06 * mean.x) << "level " << level;
        EXPECT_LE(peaks, 1) << "level " << level;
    }
}

/// Rough highlights of a smooth map are those of the many lights that stand for it.
TEST_F(Reflection, IsWhatManyLightsGive) {
    World world = test::makeWorld("builtin:sphere", test::mediumRangeMaterial());
    for (SurfaceMaterial& look : world.looks) {
        look.roughness = 0.7f;
    }
    auto smooth = std::make_shared<EnvironmentMap>(map(128, glm::vec3(0.0f)));
    for (int y = 0; y < smooth->height; ++y) {
        for (int x = 0; x < smooth->width; ++x) {
            const double phi = 2.0 * M_PI * (x + 0.5) / smooth->width;
            const double theta = M_PI * (y + 0.5) / smooth->height;
            smooth->radiance[static_cast<std::size_t>(y * smooth->width + x)] = glm::vec3(
                float(1.0 + 0.8 * std::cos(theta)), float(1.0 + 0.6 * std::sin(phi)), 1.0f);
        }
    }
    const glm::ivec2 size(64, 48);
    FrameSettings settings = test::smallFrame(size, 16);
    settings.layers = false;
    settings.shadows = false;
    settings.splatting.irradianceLevels = settings.splatting.splattingLevels = 1;
    const Camera camera = test::defaultCamera(world, size);
    const std::vector<Light> lights = environmentLights(*smooth, 256);
    const FloatImage plain = test::renderFrame(context(), world, settings, camera, lights).image;
    settings.specular = true;
    FrameRenderer renderer(context(), world, settings);
    const FloatImage byLights = renderer.render(camera, lights).image;
    renderer.setEnvironment({smooth, 1.0, 0.0, 256});
    const FloatImage byMap = renderer.render(camera, {}).image;
    renderer.setEnvironment({smooth, 1.0, M_PI, 256});
    const FloatImage turned = renderer.render(camera, {}).image;
    glm::dvec3 a(0.0);
    glm::dvec3 b(0.0);
    glm::dvec3 t(0.0);
    glm::dvec3 w(0.0);
    double difference = 0.0;
    double total = 0.0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double lights256 =
                    static_cast<double>(byLights.at(x, y, c) - plain.at(x, y, c));
                const double whole = static_cast<double>(byMap.at(x, y, c) - plain.at(x, y, c));
                a[c] += lights256;
                b[c] += whole;
                w[c] += static_cast<double>(byMap.at(x, y, c));
                t[c] += static_cast<double>(turned.at(x, y, c));
                difference += (lights256 - whole) * (lights256 - whole);
                total += lights256 * lights256;
            }
        }
    }
    fmt::print("[ measured ] map over lights: {:.4f} {:.4f} {:.4f}, relative RMSE {:.3f}\n",
               b.x / a.x, b.y / a.y, b.z / a.z, std::sqrt(difference / total));
    // The split sum sees every lobe as from above: rims, whose lobe is stretched, differ most.
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(b[c], a[c], 0.05 * a[c]);
    }
    EXPECT_LT(std::sqrt(difference / total), 0.12);
    EXPECT_GT(std::abs(t.y - w.y), 0.02 * w.y); // turned by half, the bright side is on the other
}

} // namespace
} // namespace celadon
