#include "renderer/gl/shader_source.h"
#include "subedit/errors.h"

#include <glad/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace celadon::gl {
namespace {

using shaders::EmbeddedShader;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::array kFiles{
    EmbeddedShader{"pass.frag", "// a pass\n#include \"a.glsl\"\nvoid main() {}\n"},
    EmbeddedShader{"include/a.glsl",
                   "#include \"b.glsl\"\n  #  include   \"c.glsl\" // shared\nA\n"},
    EmbeddedShader{"include/b.glsl", "#include \"include/c.glsl\"\nB"},
    EmbeddedShader{"include/c.glsl", "C\n"},
    EmbeddedShader{"loop.comp", "\n#include \"loop_a.glsl\"\n"},
    EmbeddedShader{"include/loop_a.glsl", "#include \"loop_b.glsl\"\n"},
    EmbeddedShader{"include/loop_b.glsl", "\n\n#include \"loop_a.glsl\"\n"},
    EmbeddedShader{"missing.vert", "\n#include \"nowhere.glsl\"\n"},
    EmbeddedShader{"quotes.vert", "#include <a.glsl>\n"},
    EmbeddedShader{"branch.vert", "#ifdef X\n#include \"c.glsl\"\n#endif\n"},
    EmbeddedShader{"after_branch.vert", "#ifdef X\n#endif\n#include \"c.glsl\"\n"},
    EmbeddedShader{"version.vert", "\n#version 330\n"},
    EmbeddedShader{
        "comments.vert",
        "// #include \"nowhere.glsl\"\n/*\n#include \"nowhere.glsl\"\n*/\nvoid main() {}\n"},
    EmbeddedShader{"open.vert", "void main() {} /* and so on\n"},
    EmbeddedShader{"noted.txt", "C\n"},
};

const ShaderLibrary& library() {
    static const ShaderLibrary files{std::span<const EmbeddedShader>(kFiles)};
    return files;
}

std::string errorOf(const char* path) {
    try {
        static_cast<void>(ShaderSource::load(library(), path));
    } catch (const ShaderError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ShaderSource, PutsVersionAndDefinesFirstAndIncludesOnce) {
    const ShaderSource source =
        ShaderSource::load(library(), "pass.frag", {{"LEVELS", "3"}, {"FAST", ""}});
    EXPECT_EQ(source.stage(), unsigned{GL_FRAGMENT_SHADER});
    EXPECT_EQ(source.path(), "pass.frag");
    EXPECT_THAT(source.files(),
                ElementsAre("pass.frag", "include/a.glsl", "include/b.glsl", "include/c.glsl"));
    EXPECT_EQ(source.text(), "#version 450 core\n"
                             "#define LEVELS 3\n"
                             "#define FAST \n"
                             "#line 100001 1\n"
                             "// a pass\n"
                             "#line 200001 2\n"
                             "#line 300001 3\n"
                             "#line 400001 4\n"
                             "C\n"
                             "#line 300002 3\n"
                             "B\n"
                             "#line 200002 2\n"
                             "#line 200003 2\n"
                             "A\n"
                             "#line 100003 1\n"
                             "void main() {}\n");
}

TEST(ShaderSource, ReportsCyclesWithTheirPath) {
    const std::string error = errorOf("loop.comp");
    EXPECT_THAT(error, HasSubstr("include/loop_b.glsl:3"));
    EXPECT_THAT(error, HasSubstr("loop.comp -> include/loop_a.glsl -> include/loop_b.glsl -> "
                                 "include/loop_a.glsl"));
}

TEST(ShaderSource, ErrorsNameFileAndLine) {
    EXPECT_THAT(errorOf("missing.vert"), HasSubstr("missing.vert:2"));
    EXPECT_THAT(errorOf("missing.vert"), HasSubstr("\"nowhere.glsl\""));
    EXPECT_THAT(errorOf("quotes.vert"), HasSubstr("quotes.vert:1"));
    EXPECT_THAT(errorOf("branch.vert"), HasSubstr("branch.vert:2"));
    EXPECT_THAT(errorOf("version.vert"), HasSubstr("version.vert:2"));
    EXPECT_THAT(errorOf("open.vert"), HasSubstr("open.vert:1"));
    EXPECT_THAT(errorOf("noted.txt"), HasSubstr("stage"));
    EXPECT_THAT(errorOf("absent.frag"), HasSubstr("'absent.frag'"));
    EXPECT_EQ(errorOf("after_branch.vert"), "no error");
}

TEST(ShaderSource, LeavesCommentsAlone) {
    EXPECT_EQ(errorOf("comments.vert"), "no error");
}

TEST(ShaderSource, MapsTheLogsOfDrivers) {
    const ShaderSource source = ShaderSource::load(library(), "pass.frag");
    const auto lines = source.translateLog("2:41(3): error: `x' undeclared\n"
                                           "4(7) : error C1008: undefined variable \"x\"\n"
                                           "ERROR: 3:12: 'x' : undeclared identifier\r\n"
                                           "\n"
                                           "0:2(1): warning: macro redefined\n"
                                           "99:1(1): error: no such source\n"
                                           "Link error: out of luck\n");
    ASSERT_EQ(lines.size(), 6U);
    EXPECT_EQ(lines[0].text(), "include/a.glsl:41: error: `x' undeclared");
    EXPECT_EQ(lines[1].text(), "include/c.glsl:7: error C1008: undefined variable \"x\"");
    EXPECT_EQ(lines[2].text(), "include/b.glsl:12: ERROR: 'x' : undeclared identifier");
    EXPECT_EQ(lines[3].text(), "options:2: warning: macro redefined");
    EXPECT_EQ(lines[4].text(), "99:1(1): error: no such source");
    EXPECT_EQ(lines[5].text(), "Link error: out of luck");
}

// Mesa says file 0 for errors within expressions.
TEST(ShaderSource, TheLineNumberTellsTheFile) {
    const ShaderSource source = ShaderSource::load(library(), "pass.frag");
    const auto lines = source.translateLog("0:200041(3): error: `x' undeclared\n"
                                           "4(400007) : error C1008: undefined variable\n"
                                           "0:9900001(3): error: no such file\n");
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].text(), "include/a.glsl:41: error: `x' undeclared");
    EXPECT_EQ(lines[1].text(), "include/c.glsl:7: error C1008: undefined variable");
    EXPECT_EQ(lines[2].file, "");
}

TEST(ShaderLibrary, EmbedsTheFilesOfTheFolder) {
    const std::filesystem::path folder = CELADON_SOURCE_DIR "/shaders";
    const ShaderLibrary onDisk(folder);
    ASSERT_FALSE(shaders::embeddedShaders().empty());
    for (const EmbeddedShader& file : shaders::embeddedShaders()) {
        EXPECT_EQ(onDisk.text(file.path), std::string(file.text)) << file.path;
        EXPECT_TRUE(onDisk.lastChange(file.path).has_value()) << file.path;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".txt" || extension == ".h" || extension == ".md" ||
            !entry.is_regular_file()) {
            continue;
        }
        const std::string path = entry.path().lexically_relative(folder).string();
        const bool listed =
            std::any_of(shaders::embeddedShaders().begin(), shaders::embeddedShaders().end(),
                        [&](const EmbeddedShader& file) { return file.path == path; });
        EXPECT_TRUE(listed) << path << " is not in shaders/CMakeLists.txt";
    }
}

TEST(ShaderLibrary, EveryShaderFindsItsIncludes) {
    const ShaderLibrary embedded(shaders::embeddedShaders());
    for (const EmbeddedShader& file : shaders::embeddedShaders()) {
        if (!file.path.ends_with(".glsl")) {
            EXPECT_NO_THROW(static_cast<void>(ShaderSource::load(embedded, file.path)))
                << file.path;
        }
    }
}

TEST(ShaderLibrary, ReadsTheFolderOfTheEnvironment) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "celadon_shader_library_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "only_here.frag") << "void main() {}\n";
    ASSERT_EQ(setenv("CELADON_SHADER_DIR", folder.c_str(), 1), 0);
    const ShaderLibrary onDisk;
    EXPECT_TRUE(onDisk.isOnDisk());
    EXPECT_EQ(onDisk.text("only_here.frag"), "void main() {}\n");
    EXPECT_EQ(onDisk.text("fullscreen.vert"), std::nullopt);
    ASSERT_EQ(setenv("CELADON_SHADER_DIR", "/nonexistent/folder", 1), 0);
    EXPECT_THROW(ShaderLibrary(), InputError);
    ASSERT_EQ(unsetenv("CELADON_SHADER_DIR"), 0);
    EXPECT_TRUE(ShaderLibrary().text("fullscreen.vert").has_value());
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace celadon::gl
