#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pass_state.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/vertex_array.h"
#include "subedit/errors.h"
#include "tests/support/gl_fixture.h"

#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <numeric>
#include <utility>

namespace celadon::gl {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

using HandleTest = test::GlTest;
using BufferTest = test::GlTest;
using TextureTest = test::GlTest;
using FramebufferTest = test::GlTest;

std::vector<float> counting(std::size_t count) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 1.0F);
    return values;
}

TEST_F(HandleTest, MovingLeavesNothingBehind) {
    Buffer buffer("a", 64);
    const GLuint id = buffer.id();
    const Buffer moved = std::move(buffer);
    EXPECT_EQ(moved.id(), id);
    EXPECT_FALSE(buffer); // NOLINT(bugprone-use-after-move): this is what is tested
    EXPECT_TRUE(glIsBuffer(id));
}

TEST_F(HandleTest, AssigningDeletesTheReplacedObjectAtOnce) {
    Texture texture = Texture::make2d("old", GL_R32F, {4, 4});
    const GLuint old = texture.id();
    texture = Texture::make2d("new", GL_R32F, {8, 8});
    EXPECT_FALSE(glIsTexture(old));
    EXPECT_TRUE(glIsTexture(texture.id()));
    EXPECT_EQ(texture.label(), "new");
}

TEST_F(HandleTest, AssigningToItselfKeepsTheObject) {
    Buffer buffer("a", 64);
    Buffer& same = buffer;
    buffer = std::move(same);
    EXPECT_TRUE(glIsBuffer(buffer.id()));
}

TEST_F(HandleTest, ObjectsCarryTheirLabels) {
    const Texture texture = Texture::make2d("irradiance", GL_R32F, {4, 4});
    std::array<char, 64> label{};
    glGetObjectLabel(GL_TEXTURE, texture.id(), label.size(), nullptr, label.data());
    EXPECT_STREQ(label.data(), "irradiance");
    const Buffer longName(std::string(1000, 'x'), 4); // longer than GL takes
}

TEST_F(BufferTest, ContentComesBack) {
    const std::vector<std::uint32_t> content{1, 2, 3, 4, 5, 6, 7};
    const Buffer buffer = Buffer::of("numbers", content);
    EXPECT_EQ(buffer.sizeBytes(), 28U);
    EXPECT_EQ(buffer.read<std::uint32_t>(), content);
    EXPECT_THAT(buffer.read<std::uint32_t>(2, 3), ElementsAre(3, 4, 5));
}

TEST_F(BufferTest, SmallContentComesBack) {
    const Buffer buffer = Buffer::of("small", std::array<std::uint16_t, 3>{7, 8, 9});
    EXPECT_EQ(buffer.sizeBytes(), 6U);
    EXPECT_THAT(buffer.read<std::uint16_t>(), ElementsAre(7, 8, 9));
}

TEST_F(BufferTest, RangesAreWrittenAndClearedAlone) {
    Buffer buffer("numbers", 8 * sizeof(int), BufferUse::Update);
    buffer.fill(5);
    buffer.write(std::array{1, 2}, 2 * sizeof(int));
    buffer.clear(6 * sizeof(int), 2 * sizeof(int));
    EXPECT_THAT(buffer.read<int>(), ElementsAre(5, 5, 1, 2, 5, 5, 0, 0));
    buffer.clear();
    EXPECT_THAT(buffer.read<int>(), Each(0));
}

TEST_F(BufferTest, EmptyOnesCanBeBoundAndRead) {
    const Buffer buffer("nothing", 0);
    EXPECT_EQ(buffer.sizeBytes(), 0U);
    buffer.bindStorage(0);
    buffer.bindUniform(0);
    EXPECT_TRUE(buffer.read<int>().empty());
    const Buffer fromEmpty = Buffer::of("nothing", std::vector<float>{});
    EXPECT_TRUE(fromEmpty);
}

TEST_F(BufferTest, MappedMemoryIsTheBuffer) {
    const Buffer upload("upload", 4 * sizeof(float), BufferUse::Upload);
    const Buffer readback("readback", 4 * sizeof(float), BufferUse::Readback);
    ASSERT_EQ(upload.mapped().size(), 16U);
    const std::array<float, 4> values{1.0F, 2.0F, 3.0F, 4.0F};
    std::memcpy(upload.mapped().data(), values.data(), sizeof(values));
    glCopyNamedBufferSubData(upload.id(), readback.id(), 0, 0, sizeof(values));
    glFinish();
    EXPECT_EQ(std::memcmp(readback.mapped().data(), values.data(), sizeof(values)), 0);
    EXPECT_TRUE(Buffer("device", 16).mapped().empty());
}

TEST_F(BufferTest, ImpossibleSizesThrowWithTheLabel) {
    try {
        const Buffer buffer("far too large", std::size_t{1} << 50);
        FAIL() << "a petabyte";
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(), HasSubstr("far too large"));
    }
    static_cast<void>(context().takeDebugMessages()); // GL_OUT_OF_MEMORY, as it should
}

TEST_F(TextureTest, FloatsComeBackUnchanged) {
    Texture texture = Texture::make2d("a", GL_RGBA32F, {5, 3});
    const std::vector<float> content = counting(5 * 3 * 4);
    texture.upload(0, content);
    EXPECT_EQ(texture.readLevel(), content);
}

TEST_F(TextureTest, RowsOfOddLengthHaveNoPadding) {
    Texture texture = Texture::make2d("a", GL_R8, {3, 3});
    const std::vector<std::uint8_t> content{0, 51, 102, 153, 204, 255, 51, 0, 255};
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8); // left behind by someone
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 100);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    texture.upload(0, content);
    const std::vector<float> read = texture.readLevel();
    ASSERT_EQ(read.size(), content.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_NEAR(read[i], static_cast<float>(content[i]) / 255.0F, 1e-6F);
    }
}

TEST_F(TextureTest, HalvesRoundToElevenBits) {
    Texture texture = Texture::make2d("a", GL_RGBA16F, {2, 2});
    const std::vector<float> content = counting(16);
    texture.upload(0, content);
    EXPECT_EQ(texture.readLevel(), content); // small integers are exact
}

TEST_F(TextureTest, IntegersComeBack) {
    Texture texture = Texture::make2d("a", GL_RG32UI, {2, 2});
    const std::vector<std::uint32_t> content{0, 1, 2, 3, 4, 5, 6, 0xffffffffU};
    texture.upload(0, content);
    EXPECT_EQ(texture.readLevelUint(), content);
    texture.clear(0, glm::uvec4(9, 8, 0, 0));
    EXPECT_THAT(texture.readLevelUint(), ElementsAre(9, 8, 9, 8, 9, 8, 9, 8));
}

TEST_F(TextureTest, LayersAndSlicesAreApart) {
    for (const bool array : {true, false}) {
        Texture texture = array ? Texture::makeArray("a", GL_RG32F, {4, 2}, 3)
                                : Texture::make3d("b", GL_RG32F, {4, 2, 3});
        const std::vector<float> content = counting(4 * 2 * 3 * 2);
        texture.upload(0, content);
        EXPECT_EQ(texture.readLevel(), content);
        texture.uploadRegion(0, {1, 0, 2}, {1, 1, 1}, std::vector<float>{-1.0F, -2.0F});
        EXPECT_THAT(texture.readRegion(0, {1, 0, 2}, {1, 1, 1}), ElementsAre(-1.0F, -2.0F));
        EXPECT_THAT(texture.readRegion(0, {1, 0, 1}, {1, 1, 1}), ElementsAre(19.0F, 20.0F));
    }
}

TEST_F(TextureTest, LevelsHaveTheSizesOfGl) {
    const Texture flat = Texture::make2d("a", GL_R32F, {13, 6}, fullLevelCount({13, 6}));
    EXPECT_EQ(flat.levels(), 4);
    for (int level = 0; level < flat.levels(); ++level) {
        GLint width = 0;
        GLint height = 0;
        glGetTextureLevelParameteriv(flat.id(), level, GL_TEXTURE_WIDTH, &width);
        glGetTextureLevelParameteriv(flat.id(), level, GL_TEXTURE_HEIGHT, &height);
        EXPECT_EQ(flat.size2d(level), glm::ivec2(width, height));
    }
    EXPECT_EQ(Texture::makeArray("b", GL_R32F, {8, 8}, 5, 3).size(2), glm::ivec3(2, 2, 5));
    EXPECT_EQ(Texture::make3d("c", GL_R32F, {8, 8, 8}, 3).size(2), glm::ivec3(2, 2, 2));
    EXPECT_EQ(fullLevelCount({1, 1}), 1);
    EXPECT_EQ(fullLevelCount({512, 512}), 10);
}

TEST_F(TextureTest, ViewsShareTexelsAndOutliveTheOriginal) {
    Texture pyramid = Texture::make2d("pyramid", GL_R32F, {8, 8}, 4);
    pyramid.clear(2, glm::vec4(3.0F));
    const Texture view = pyramid.viewLevels("level 2", 2);
    EXPECT_EQ(view.size2d(), glm::ivec2(2, 2));
    EXPECT_EQ(view.levels(), 1);
    pyramid = Texture();
    EXPECT_THAT(view.readLevel(), Each(3.0F));

    Texture array = Texture::makeArray("array", GL_R32F, {2, 2}, 3);
    array.upload(0, counting(12));
    const Texture layer = array.viewLayer("layer 1", 1);
    EXPECT_EQ(layer.target(), GLenum{GL_TEXTURE_2D});
    EXPECT_EQ(layer.size(), glm::ivec3(2, 2, 1));
    EXPECT_THAT(layer.readLevel(), ElementsAre(5.0F, 6.0F, 7.0F, 8.0F));
}

TEST_F(TextureTest, TooLargeIsRefusedWithTheLabelAndTheLimit) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    try {
        static_cast<void>(Texture::make2d("poster", GL_RGBA32F, {largest + 1, 4}));
        FAIL() << "beyond the limit";
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'poster'"));
        EXPECT_THAT(error.what(), HasSubstr(std::to_string(largest)));
    }
}

TEST_F(TextureTest, SamplersAreBoundBesideTextures) {
    const Texture texture = Texture::make2d("a", GL_RGBA32F, {4, 4});
    const Sampler sampler("trilinear", Filter::LinearMipmap, Wrap::Repeat);
    texture.bind(3);
    sampler.bind(3);
    GLint bound = 0;
    glGetIntegeri_v(GL_SAMPLER_BINDING, 3, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), sampler.id());
    Sampler::unbind(3);
}

TEST_F(FramebufferTest, ClearsEachAttachment) {
    const Texture color = Texture::make2d("color", GL_RGBA32F, {7, 5});
    const Texture index = Texture::make2d("index", GL_R32UI, {7, 5});
    const Texture depth = Texture::make2d("depth", GL_DEPTH_COMPONENT32F, {7, 5});
    Framebuffer framebuffer("target", {{&color}, {&index}}, Attachment{&depth});
    EXPECT_EQ(framebuffer.size(), glm::ivec2(7, 5));
    PassState state = PassState::covering(framebuffer);
    state.depthWrite = true;
    state.apply();
    framebuffer.clearColor(0, glm::vec4(1.0F, -2.0F, 3e20F, 0.25F));
    framebuffer.clearColor(1, glm::uvec4(77, 0, 0, 0));
    framebuffer.clearDepth(0.5F);
    EXPECT_THAT(color.readRegion(0, {6, 4, 0}, {1, 1, 1}), ElementsAre(1.0F, -2.0F, 3e20F, 0.25F));
    EXPECT_THAT(index.readLevelUint(), Each(77U));
    EXPECT_THAT(depth.readLevel(), Each(0.5F));
}

TEST_F(FramebufferTest, DrawsToOneLevelOfOneLayer) {
    Texture array = Texture::makeArray("array", GL_R32F, {8, 8}, 3, 2);
    array.clear(0, glm::vec4(0.0F));
    array.clear(1, glm::vec4(0.0F));
    Framebuffer framebuffer("layer 1 of level 1", {{&array, 1, 1}});
    EXPECT_EQ(framebuffer.size(), glm::ivec2(4, 4));
    PassState::covering(framebuffer).apply();
    framebuffer.clearColor(0, glm::vec4(2.0F));
    EXPECT_THAT(array.readLevel(0), Each(0.0F));
    EXPECT_THAT(array.readRegion(1, {0, 0, 0}, {4, 4, 1}), Each(0.0F));
    EXPECT_THAT(array.readRegion(1, {0, 0, 1}, {4, 4, 1}), Each(2.0F));
    EXPECT_THAT(array.readRegion(1, {0, 0, 2}, {4, 4, 1}), Each(0.0F));
}

TEST_F(FramebufferTest, IncompleteOnesAreRefusedByName) {
    const Texture layered = Texture::makeArray("layered", GL_RGBA32F, {4, 4}, 2);
    const Texture flat = Texture::make2d("flat", GL_RGBA32F, {4, 4});
    try {
        const Framebuffer framebuffer("mixture", {{&layered}, {&flat}});
        FAIL() << "layered and not";
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'mixture'"));
        EXPECT_THAT(error.what(), HasSubstr("layered"));
    }
    EXPECT_THROW(Framebuffer("nothing", {}), ContextError);
    EXPECT_EQ(Framebuffer::withoutAttachments("stores only", {64, 32}).size(), glm::ivec2(64, 32));
}

TEST_F(FramebufferTest, ScissorLimitsAClear) {
    const Texture color = Texture::make2d("color", GL_R32F, {2, 2});
    Framebuffer framebuffer("target", {{&color}});
    PassState state = PassState::covering(framebuffer);
    state.apply();
    framebuffer.clearColor(0, glm::vec4(1.0F));
    state.scissor = glm::ivec4(1, 0, 1, 1);
    state.apply();
    framebuffer.clearColor(0, glm::vec4(5.0F));
    EXPECT_THAT(color.readLevel(), ElementsAre(1.0F, 5.0F, 1.0F, 1.0F));
}

} // namespace
} // namespace celadon::gl
