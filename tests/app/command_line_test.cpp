#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace celadon {
namespace {

using test::ProgramResult;
using test::runInProcess;
using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(CommandLine, ShowsHelpOnStdout) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                  {"render", "--help"},
                                                  {"compare", "-h"},
                                                  {"profile", "--help"},
                                                  {"profile", "make", "--help"},
                                                  {"material", "-h"}}) {
        const ProgramResult result = runInProcess(words);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_THAT(result.out, HasSubstr("--help"));
        EXPECT_EQ(result.err, "");
    }
    EXPECT_THAT(runInProcess({"render", "--help"}).out, HasSubstr("--view-from"));
    EXPECT_THAT(runInProcess({"profile", "make", "--help"}).out, HasSubstr("--preset"));
    EXPECT_THAT(runInProcess({"material", "--help"}).out, HasSubstr("bake"));
}

TEST(CommandLine, ShowsTheVersion) {
    const ProgramResult result = runProgram({"--version"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.out, testing::StartsWith("celadon "));
}

TEST(CommandLine, WantsACommand) {
    const ProgramResult result = runProgram({});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err,
                testing::MatchesRegex("celadon: command line: no command is given; choose "
                                      "[a-z, ]*render, [a-z, ]+; see 'celadon --help'\n"));
    const ProgramResult nested = runInProcess({"material"});
    EXPECT_EQ(nested.exitCode, 2);
    EXPECT_THAT(nested.err,
                testing::MatchesRegex("celadon material: no command is given; choose bake, "
                                      "[a-z, ]+; see 'celadon material --help'\n"));
}

TEST(CommandLine, NamesWhatItDoesNotKnow) {
    struct Case {
        std::vector<std::string> words;
        const char* says;
    };
    const std::vector<Case> cases = {
        {{"rendr"}, "did you mean 'render'?"},
        {{"render", "m.obj", "--alhpa", "3"}, "'--alhpa': unknown option; did you mean '--alpha'?"},
        {{"render", "m.obj", "--bogus=1"}, "'--bogus': unknown option"},
        {{"render", "m.obj", "-q"}, "'-q'"},
        {{"--bogus"}, "see 'celadon --help'"},
        {{"render", "m.obj", "-o", "a.png", "more"}, "'more': unexpected argument"},
        {{"render", "m.obj", "-o"}, "--output: its value is missing"},
        {{"render", "m.obj", "-o", "--aov"}, "a value is missing"},
        {{"render", "m.obj", "-o", "a.png", "--no-adaptive=1"}, "takes no value"},
        {{"compare", "a.exr"}, "two pictures"},
        {{"compare", "a", "b", "--metric", "rsme"},
         "'rsme': is no metric; choose rmse, "
         "relative-rmse, psnr, ssim, flip, flip-hdr,"},
        {{"render", "m.obj", "--bogus", "--", "more"}, "'--bogus': unknown option"},
        {{"render", "-o", "a.png", "--", "m.obj", "--aov"},
         "'--aov': unexpected argument; see 'celadon render --help'"},
        {{"compare", "a", "b", "--fail-above", "rmse"}, "METRIC=VALUE"},
        {{"profile", "mkae"}, "'mkae': unknown command; did you mean 'make'?"},
        {{"material", "--jsno"}, "see 'celadon material --help'"},
        {{"profile", "make", "--perset", "marble"}, "did you mean '--preset'?"},
        {{"profile", "make", "--preset"},
         "--preset: its value is missing; see 'celadon profile make"},
        {{"profile", "make", "--preset", "marble", "--model", "bipole"}, "--model 'bipole'"},
        {{"profile", "table"}, "no material"},
        {{"material", "info"}, "no material"},
        {{"material", "info", "marble", "more"}, "'more': unexpected argument"},
        {{"material", "bake", "--segments", "0"}, "--segments"},
        {{"info"}, "no file"},
        {{"info", "--system", "a.obj"}, "--system"},
    };
    for (const Case& c : cases) {
        const ProgramResult result = runInProcess(c.words);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_THAT(result.err, HasSubstr(c.says));
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_EQ(result.out, "");
    }
}

TEST(CommandLine, EndsWithOneLineAndACode) {
    const ProgramResult usage = runProgram({"render", "--bogus"});
    EXPECT_EQ(usage.exitCode, 2);
    EXPECT_EQ(usage.err, "celadon: '--bogus': unknown option; see 'celadon render --help'\n");
    const ProgramResult input = runProgram({"compare", "no such.exr", "b.exr"});
    EXPECT_EQ(input.exitCode, 3);
    EXPECT_EQ(input.errorLines(), 1);
}

TEST(CommandLine, RefusesOutputsBeforeTheWork) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runProgram({"render", "m.obj", "-o", (folder / "missing/a.exr").string()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("does not exist"));
    EXPECT_EQ(result.errorLines(), 1);
}

TEST(CommandLine, TakesPositionalsAfterTwoDashes) {
    EXPECT_EQ(runInProcess({"material", "info", "--", "marble"}).exitCode, 0);
    const ProgramResult dashed = runInProcess({"info", "--", "-m.obj"});
    EXPECT_EQ(dashed.exitCode, 3);
    EXPECT_THAT(dashed.err, HasSubstr("'-m.obj'"));
}

TEST(CommandLine, SaysThatPathsAreRoundedUp) {
    EXPECT_THAT(runInProcess({"render", "--help"}).out, HasSubstr("rounded up to whole"));
}

TEST(CommandLine, EveryCommandCanTellWhatItDoes) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"profile", "table", "marble", "--verbose"},
          {"material", "info", "marble", "--verbose"},
          {"info", "marble", "--verbose"}}) {
        EXPECT_EQ(runInProcess(words).exitCode, 0);
    }
    EXPECT_EQ(runInProcess({"info", "marble"}).exitCode, 0); // no longer verbose
}

TEST(CommandLine, FailsWhenStdoutCannotBeWritten) {
    const ProgramResult result = runProgram({"--help"}, "/dev/full");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("standard output"));
}

TEST(CommandLine, ListsTheContextsOfTheSystem) {
    const ProgramResult result = runProgram({"info", "--system"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("egl"));
    EXPECT_THAT(result.out, HasSubstr("osmesa"));
    EXPECT_THAT(result.out, HasSubstr("glfw"));
}

} // namespace
} // namespace celadon
