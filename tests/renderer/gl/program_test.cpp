#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pass_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/gl/vertex_array.h"
#include "subedit/errors.h"
#include "tests/support/gl_fixture.h"

#include <gmock/gmock.h>

#include <array>

namespace celadon::gl {
namespace {

using shaders::EmbeddedShader;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kFiles{
    EmbeddedShader{"fullscreen.vert", R"(
void main() {
    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(p, 0.0, 1.0);
})"},
    EmbeddedShader{"constant.frag", R"(
layout(location = 0) uniform vec4 value;
layout(location = 7) uniform float unused;
layout(location = 0) out vec4 color;
void main() { color = value; })"},
    EmbeddedShader{"points.vert", R"(
layout(location = 2) in vec2 position;
layout(location = 5) in uint count;
flat out uint total;
void main() { gl_Position = vec4(position, 0.0, 1.0); gl_PointSize = 1.0; total = count; })"},
    EmbeddedShader{"points.frag", R"(
flat in uint total;
layout(location = 0) out float color;
void main() { color = float(total); })"},
    EmbeddedShader{"square.comp", R"(
layout(local_size_x = 4) in;
layout(std430, binding = 1) buffer Numbers { uint numbers[]; };
layout(location = 3) uniform uint offset;
void main() {
    if (gl_GlobalInvocationID.x < numbers.length()) {
        numbers[gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x * gl_GlobalInvocationID.x + offset;
    }
})"},
    EmbeddedShader{"busy.comp", R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Out { float result[]; };
void main() {
    float x = float(gl_GlobalInvocationID.x);
    for (int i = 0; i < 20000; ++i) { x = x * 0.999 + 0.5; }
    result[gl_GlobalInvocationID.x] = x;
})"},
    EmbeddedShader{"broken.comp", "layout(local_size_x = 1) in;\n#include \"profile.glsl\"\n"
                                  "void main() { profile(1.0); }\n"},
    EmbeddedShader{"include/profile.glsl", "\n\n\nfloat profile(float r) {\n"
                                           "    return r * undeclared;\n}\n"},
    EmbeddedShader{"unlinked.frag", R"(
layout(location = 0) out vec4 color;
vec4 elsewhere();
void main() { color = elsewhere(); })"},
    EmbeddedShader{"option.comp", "layout(local_size_x = SIZE) in;\nvoid main() {}\n"},
};

class ProgramTest : public test::GlTest {
protected:
    ShaderLibrary library{std::span<const EmbeddedShader>(kFiles)};

    Texture drawConstantTwice(Blend blend, glm::vec4 first, glm::vec4 second) {
        Texture color = Texture::make2d("color", GL_RGBA32F, {4, 4});
        Framebuffer framebuffer("target", {{&color}});
        const Program program("constant", library, {"fullscreen.vert", "constant.frag"});
        const VertexArray none("none");
        PassState state = PassState::covering(framebuffer);
        state.blend = blend;
        state.apply();
        framebuffer.clearColor(0, glm::vec4(0.0F));
        program.use();
        none.bind();
        for (const glm::vec4 value : {first, second}) {
            program.set(0, value);
            glDrawArrays(GL_TRIANGLES, 0, 3);
        }
        return color;
    }
};

TEST_F(ProgramTest, AdditiveBlendingOfFloatsIsNotClamped) {
    const Texture color = drawConstantTwice(Blend::Additive, glm::vec4(1.5F, 1e6F, -1.0F, 0.0F),
                                            glm::vec4(2.0F, 1.0F, -1.0F, 0.25F));
    EXPECT_THAT(color.readRegion(0, {3, 3, 0}, {1, 1, 1}),
                ElementsAre(3.5F, 1000001.0F, -2.0F, 0.25F));
}

TEST_F(ProgramTest, MaxBlendingKeepsTheLarger) {
    const Texture color = drawConstantTwice(Blend::Max, glm::vec4(5.0F, 0.5F, -1.0F, 2.0F),
                                            glm::vec4(2.0F, 1.0F, -2.0F, 3.0F));
    EXPECT_THAT(color.readRegion(0, {0, 0, 0}, {1, 1, 1}), ElementsAre(5.0F, 1.0F, 0.0F, 3.0F));
}

TEST_F(ProgramTest, WithoutBlendingTheLastWins) {
    const Texture color = drawConstantTwice(Blend::None, glm::vec4(5.0F), glm::vec4(2.0F));
    EXPECT_THAT(color.readLevel(), Each(2.0F));
}

TEST_F(ProgramTest, PassStateForgetsWhatWasSetBefore) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 1, 1);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT_AND_BACK);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NEVER, 0, 0);
    glEnable(GL_RASTERIZER_DISCARD);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glEnable(GL_CLIP_DISTANCE3);
    const Texture color = drawConstantTwice(Blend::None, glm::vec4(5.0F), glm::vec4(2.0F));
    EXPECT_THAT(color.readLevel(), Each(2.0F));
}

TEST_F(ProgramTest, UnusedUniformsAreIgnored) {
    const Program program("constant", library, {"fullscreen.vert", "constant.frag"});
    program.set(7, 1.0F);
}

TEST_F(ProgramTest, VertexAttributesReachTheShader) {
    struct Vertex {
        glm::vec2 position;
        std::uint16_t count, padding;
    };
    const std::array<Vertex, 3> vertices{
        {{{-0.75F, -0.75F}, 3, 0}, {{0.75F, -0.75F}, 40000, 0}, {{0.75F, 0.75F}, 5, 0}}};
    const Buffer buffer = Buffer::of("points", vertices);
    const Buffer indices = Buffer::of("indices", std::array<std::uint32_t, 2>{1, 2});
    VertexArray array("points");
    array.setBuffer(0, buffer, sizeof(Vertex));
    array.setAttribute(0, {2, 2, GL_FLOAT, offsetof(Vertex, position)});
    array.setAttribute(0,
                       {5, 1, GL_UNSIGNED_SHORT, offsetof(Vertex, count), AttributeKind::Integer});
    array.setIndexBuffer(indices);
    const Texture color = Texture::make2d("color", GL_R32F, {4, 4});
    Framebuffer framebuffer("target", {{&color}});
    const Program program("points", library, {"points.vert", "points.frag"});
    PassState::covering(framebuffer).apply();
    framebuffer.clearColor(0, glm::vec4(0.0F));
    program.use();
    array.bind();
    glDrawElements(GL_POINTS, 2, GL_UNSIGNED_INT, nullptr);
    EXPECT_THAT(color.readLevel(), ElementsAre(0, 0, 0, 40000, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5));
}

TEST_F(ProgramTest, ComputeSeesTheLengthOfTheContent) {
    Buffer numbers("numbers", 3 * sizeof(std::uint32_t)); // less than the smallest storage
    const Program program("square", library, {"square.comp"});
    program.set(3, 10U);
    program.use();
    numbers.bindStorage(1);
    glDispatchCompute(1, 1, 1);
    EXPECT_THAT(numbers.read<std::uint32_t>(), ElementsAre(10, 11, 14));
}

TEST_F(ProgramTest, CompileErrorsNameTheFileAndLineOfTheInclude) {
    try {
        const Program program("broken", library, {"broken.comp"});
        FAIL() << "an undeclared name";
    } catch (const ShaderError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'broken'"));
        EXPECT_THAT(error.what(), HasSubstr("include/profile.glsl:5"));
        EXPECT_THAT(error.what(), HasSubstr("undeclared"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST_F(ProgramTest, BuildReportsInsteadOfThrowing) {
    std::vector<ShaderDiagnostic> diagnostics;
    const std::array stages{ShaderSource::load(library, "broken.comp")};
    EXPECT_FALSE(Program::build("broken", stages, diagnostics).has_value());
    ASSERT_FALSE(diagnostics.empty());
    EXPECT_EQ(diagnostics.front().file, "include/profile.glsl");
    EXPECT_EQ(diagnostics.front().line, 5);
}

TEST_F(ProgramTest, LinkErrorsThrow) {
    EXPECT_THROW(Program("unlinked", library, {"fullscreen.vert", "unlinked.frag"}), ShaderError);
}

TEST_F(ProgramTest, DefinesReachTheShader) {
    const Program program("option", library, {"option.comp"}, {{"SIZE", "17"}});
    std::array<GLint, 3> size{};
    glGetProgramiv(program.id(), GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    EXPECT_THAT(size, ElementsAre(17, 1, 1));
}

TEST_F(ProgramTest, EmbeddedFullscreenTriangleCompiles) {
    std::vector<ShaderDiagnostic> diagnostics;
    const std::array stages{
        ShaderSource::load(ShaderLibrary(shaders::embeddedShaders()), "fullscreen.vert"),
        ShaderSource::load(library, "constant.frag")};
    EXPECT_TRUE(Program::build("fullscreen", stages, diagnostics).has_value());
    EXPECT_THAT(diagnostics, testing::IsEmpty());
}

TEST_F(ProgramTest, TimerMeasuresWorkRatherThanItsSubmission) {
    const Program program("busy", library, {"busy.comp"});
    const Buffer buffer("out", 64 * 256 * sizeof(float));
    buffer.bindStorage(0);
    program.use();
    const auto run = [&](GLuint groups) {
        glDispatchCompute(groups, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };
    run(1); // compiles
    StageTimer timer(context());
    {
        const auto frame = timer.measure("frame");
        {
            const auto stage = timer.measure("little");
            run(1);
        }
        const auto stage = timer.measure("much");
        run(256);
    }
    const std::vector<StageTime> times = timer.take();
    ASSERT_EQ(times.size(), 3U);
    EXPECT_EQ(times[0].stage, "frame");
    EXPECT_EQ(times[1].stage, "little");
    EXPECT_EQ(times[2].stage, "much");
    EXPECT_GT(times[1].timeMs, 0.0);
    EXPECT_GT(times[2].timeMs, 2.0 * times[1].timeMs); // 256 times the work, on several threads
    EXPECT_GE(times[0].timeMs, times[1].timeMs + times[2].timeMs);
    EXPECT_TRUE(timer.ready());
    EXPECT_TRUE(timer.take().empty());
}

} // namespace
} // namespace celadon::gl
