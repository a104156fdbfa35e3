#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/texture.h"
#include "subedit/errors.h"
#include "tests/support/gl_fixture.h"

#include <gmock/gmock.h>

#include <dirent.h>

namespace celadon::gl {
namespace {

using test::testContextKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

int openFileCount() {
    int count = 0;
    DIR* const folder = opendir("/proc/self/fd");
    while (folder != nullptr && readdir(folder) != nullptr) {
        ++count;
    }
    if (folder != nullptr) {
        closedir(folder);
    }
    return count;
}

TEST(Context, KindsRoundTripThroughTheirNames) {
    for (const char* word : {"auto", "glfw", "egl", "osmesa"}) {
        EXPECT_STREQ(contextKindName(parseContextKind(word)), word);
    }
}

TEST(Context, RefusesUnknownKinds) {
    EXPECT_THROW(static_cast<void>(parseContextKind("EGL")), UsageError);
    EXPECT_THROW(static_cast<void>(parseContextKind("")), UsageError);
}

TEST(Context, IsTheKindThatWasAskedForAndCurrent) {
    const auto context = createContext(testContextKind());
    if (testContextKind() != ContextKind::Auto) {
        EXPECT_EQ(context->kind(), testContextKind());
    }
    EXPECT_EQ(Context::current(), context.get());
    EXPECT_FALSE(context->renderer().empty());
    EXPECT_THAT(context->description(), HasSubstr(contextKindName(context->kind())));
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &flags);
    EXPECT_TRUE(flags & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_THAT(context->takeDebugMessages(), IsEmpty());
}

TEST(Context, ComesAndGoesWithoutLeavingFilesOpen) {
    static_cast<void>(createContext(testContextKind())); // loads the driver
    const int before = openFileCount();
    for (int i = 0; i < 10; ++i) {
        const auto context = createContext(testContextKind());
        const Texture texture = Texture::make2d("target", GL_RGBA32F, {64, 64});
        EXPECT_THAT(context->takeDebugMessages(), IsEmpty());
    }
    EXPECT_EQ(Context::current(), nullptr);
    EXPECT_LE(openFileCount(), before);
}

TEST(Context, TwoLiveAtOnce) {
    const auto first = createContext(testContextKind());
    const Buffer inFirst = Buffer::of("first", std::vector<int>{1, 2, 3, 4, 5});
    const auto second = createContext(testContextKind());
    EXPECT_EQ(Context::current(), second.get());
    {
        const Buffer inSecond = Buffer::of("second", std::vector<int>{6, 7, 8, 9, 10});
        first->makeCurrent();
        EXPECT_EQ(Context::current(), first.get());
        EXPECT_THAT(inFirst.read<int>(), ElementsAre(1, 2, 3, 4, 5));
        second->makeCurrent();
        EXPECT_THAT(inSecond.read<int>(), ElementsAre(6, 7, 8, 9, 10));
    }
    first->makeCurrent();
}

// Mesa's EGL and OSMesa share a library that keeps the current context.
TEST(Context, BackendsLiveSideBySide) {
    const auto mine = createContext(testContextKind());
    Buffer buffer("mine", 64, BufferUse::Update);
    for (const ContextKind kind : {ContextKind::Egl, ContextKind::Osmesa}) {
        std::unique_ptr<Context> other;
        try {
            other = createContext(kind);
        } catch (const ContextError& error) {
            mine->makeCurrent();
            GTEST_SKIP() << error.what();
        }
        {
            const Buffer theirs = Buffer::of("theirs", std::vector<int>(16, 7));
            mine->makeCurrent();
            buffer.fill(static_cast<GLuint>(kind));
            other->makeCurrent();
            EXPECT_THAT(theirs.read<int>(), testing::Each(7));
        }
        mine->makeCurrent();
        EXPECT_THAT(buffer.read<int>(), testing::Each(static_cast<int>(kind)));
        EXPECT_THAT(other->takeDebugMessages(), IsEmpty());
        other.reset();
        EXPECT_EQ(Context::current(), mine.get());
    }
    EXPECT_THAT(mine->takeDebugMessages(), IsEmpty());
}

TEST(Context, CollectsErrorsWithGroupsAndLabelsOnce) {
    const auto context = createContext(testContextKind());
    const Buffer buffer("samples of the knee", 64); // not for updates
    {
        const DebugGroup outer("splatting");
        const DebugGroup inner("level 2");
        const int value = 1;
        glNamedBufferSubData(buffer.id(), 0, sizeof(value), &value);
    }
    glEnable(GL_TEXTURE_2D); // not in a core profile
    const std::vector<std::string> messages = context->takeDebugMessages();
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_THAT(messages[0], HasSubstr("'splatting' > 'level 2'"));
    EXPECT_THAT(messages[0], HasSubstr("GL_INVALID_OPERATION"));
    EXPECT_THAT(messages[1], testing::Not(HasSubstr("splatting")));
    EXPECT_THAT(context->takeDebugMessages(), IsEmpty());
}

TEST(Context, MessagesNameObjectsByTheirLabels) {
    const auto context = createContext(testContextKind());
    const Buffer buffer("samples of the knee", 64);
    const std::string text = "Buffer object " + std::to_string(buffer.id()) + " is not well";
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_ERROR, 1,
                         GL_DEBUG_SEVERITY_HIGH, -1, text.c_str());
    EXPECT_THAT(context->takeDebugMessages(), ElementsAre(HasSubstr("'samples of the knee'")));
}

TEST(Context, KeepsQuietAboutChatter) {
    const auto context = createContext(testContextKind());
    const auto say = [](GLenum type, GLenum severity) {
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, severity, -1, "hello");
    };
    say(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_NOTIFICATION);
    say(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_MEDIUM);
    say(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_MEDIUM);
    say(GL_DEBUG_TYPE_ERROR, GL_DEBUG_SEVERITY_LOW);
    EXPECT_THAT(context->takeDebugMessages(), IsEmpty());
    say(GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DEBUG_SEVERITY_MEDIUM);
    EXPECT_EQ(context->takeDebugMessages().size(), 1U);
}

TEST(Context, ProbesListEachBackendAndKeepTheCurrentOne) {
    const auto context = createContext(testContextKind());
    const std::vector<ContextProbe> probes = probeContexts();
    EXPECT_EQ(Context::current(), context.get());
    ASSERT_GE(probes.size(), 3U); // EGL, GLFW, OSMesa
    bool found = false;
    for (const ContextProbe& probe : probes) {
        EXPECT_NE(probe.works, !probe.reason.empty()) << probe.backend;
        EXPECT_EQ(probe.works, !probe.limits.empty()) << probe.backend;
        found = found || (probe.works && probe.backend == context->description());
        for (const auto& [name, value] : probe.limits) {
            EXPECT_GT(value, 0) << probe.backend << " " << name;
        }
    }
    EXPECT_TRUE(found);
    EXPECT_THAT(context->takeDebugMessages(), IsEmpty());
}

TEST(Context, ObjectsThatOutliveTheirContextAreLetGo) {
    auto context = createContext(testContextKind());
    Buffer orphan("orphan", 64);
    context.reset();
    orphan = Buffer(); // must not crash for want of a context
    EXPECT_FALSE(orphan);
}

} // namespace
} // namespace celadon::gl
