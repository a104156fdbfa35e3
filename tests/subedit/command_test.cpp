// `celadon profile` and `celadon material` as a user runs them.
#include "subedit/map/material_file.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

namespace celadon::subedit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
    int exitCode;
    std::string output;
    std::string errors;
};

class Command : public testing::Test {
protected:
    Outcome run(const std::string& arguments) {
        const std::filesystem::path errors = folder / "stderr";
        const std::string line =
            std::string(CELADON_PROGRAM) + ' ' + arguments + " 2>" + errors.string();
        FILE* pipe = ::popen(line.c_str(), "r");
        std::string output;
        std::array<char, 4096> buffer;
        std::size_t count = 0;
        while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0) {
            output.append(buffer.data(), count);
        }
        const int status = ::pclose(pipe);
        std::stringstream text;
        text << std::ifstream(errors).rdbuf();
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output, text.str()};
    }

    void expectRefused(const std::string& arguments, int exitCode,
                       const testing::Matcher<std::string>& message) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, exitCode) << arguments << '\n' << outcome.errors;
        EXPECT_THAT(outcome.errors, message) << arguments;
        EXPECT_EQ(outcome.output, "") << arguments;
    }

    std::string path(const std::string& name) const { return (folder / name).string(); }

    test::TemporaryFolder folder;
};

TEST_F(Command, ProfileMakeWritesCsvToStdout) {
    const Outcome outcome = run("profile make --preset marble");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, StartsWith("r_mm,R,G,B\n0,"));
    EXPECT_EQ(outcome.errors, "");
}

TEST_F(Command, ProfileMakeLeavesOutAnInfiniteFirstRow) {
    const Outcome outcome = run("profile make --model normalized-diffusion --albedo 0.9,0.7,0.5 "
                                "--mean-free-path 2 --max-radius 25.6");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    const std::string header = "r_mm,R,G,B\n";
    ASSERT_THAT(outcome.output, StartsWith(header));
    const double first = std::stod(outcome.output.substr(header.size()));
    EXPECT_GT(first, 0.0);
    EXPECT_LT(first, 0.1);
}

TEST_F(Command, ProfileMakeWritesAMaterialWithTheModelsAlbedo) {
    const Outcome outcome = run("profile make --absorption 0.0021,0.0041,0.0071 "
                                "--reduced-scattering 2.19,2.62,3 --eta 1.5 --segments 40 -o " +
                                path("m.subedit.exr"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    const MaterialMap map = readMaterial(folder / "m.subedit.exr");
    EXPECT_EQ(map.segments, 40);
    EXPECT_EQ(map.name, "m");
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 0.83, 0.005);
}

TEST_F(Command, ProfileMakeRefusesWhatIsNoMedium) {
    expectRefused("profile make", 2, HasSubstr("no medium is given"));
    expectRefused("profile make --preset marble --albedo 1", 2, HasSubstr("more than one way"));
    expectRefused("profile make --preset mrable", 2,
                  AllOf(HasSubstr("mrable"), HasSubstr("skin1")));
    expectRefused("profile make --absorption 1", 2, HasSubstr("--reduced-scattering is missing"));
    expectRefused("profile make --absorption 1,-2,3 --reduced-scattering 1", 2,
                  AllOf(HasSubstr("--absorption"), HasSubstr("green is -2")));
    expectRefused("profile make --absorption nan --reduced-scattering 1", 2,
                  HasSubstr("--absorption"));
    expectRefused("profile make --albedo 1.2 --mean-free-path 1", 2, HasSubstr("--albedo"));
    expectRefused("profile make --albedo 1,2 --mean-free-path 1", 2, HasSubstr("not R,G,B"));
    expectRefused("profile make --preset marble --eta 0", 2, HasSubstr("--eta"));
    expectRefused("profile make --preset marble --segments 257", 2, HasSubstr("--segments"));
    expectRefused("profile make --preset marble -o " + path("x.jpg"), 2, HasSubstr("x.jpg"));
    expectRefused("profile make --preset marble -o /absent/folder/x.csv", 1,
                  HasSubstr("'/absent/folder/x.csv'"));
}

TEST_F(Command, ProfileTableGivesBothCurves) {
    const Outcome outcome = run("profile table marble");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output,
                AllOf(StartsWith("r,meanProfile\n0,"), HasSubstr("\n\nT,minimalRadius\n1,1\n"),
                      HasSubstr("\n4096,")));
}

TEST_F(Command, MaterialBakeFollowsARecipe) {
    const Outcome outcome =
        run("material bake --recipe jade --size 16 -o " + path("j.subedit.exr"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_EQ(readMaterial(folder / "j.subedit.exr").width, 16);
    expectRefused("material bake --recipe plastic -o " + path("p.subedit.exr"), 2,
                  AllOf(HasSubstr("plastic"), HasSubstr("yellow_wax")));
    expectRefused("material bake --recipe jade", 2, HasSubstr("-o is missing"));
    expectRefused("material bake -o " + path("p.subedit.exr"), 2, HasSubstr("nothing to bake"));
    EXPECT_FALSE(std::filesystem::exists(folder / "p.subedit.exr"));
}

TEST_F(Command, MaterialBakeDecodesSrgbImages) {
    // 2 x 1 pixels: black, and sRGB 188, which is 0.5029 linear.
    std::ofstream(folder / "a.ppm", std::ios::binary)
        << "P6 2 1 255\n"
        << std::string(3, '\0') << std::string(3, '\xbc');
    const Outcome outcome = run("material bake --albedo " + path("a.ppm") +
                                " --mean-free-path 1,0.5,0.25 -o " + path("b.subedit.exr"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    const MaterialMap map = readMaterial(folder / "b.subedit.exr");
    ASSERT_EQ(map.width, 2);
    EXPECT_LT(diffuseAlbedo(profileAt(map, 0, 0)).x, 1e-6);
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 1, 0)).y, 0.5029, 1e-3);
}

TEST_F(Command, MaterialBakeRefusesMapsThatDoNotFit) {
    std::ofstream(folder / "a.ppm", std::ios::binary) << "P6 2 1 255\n" << std::string(6, 'a');
    std::ofstream(folder / "b.ppm", std::ios::binary) << "P6 1 3 255\n" << std::string(9, 'a');
    const std::string output = " -o " + path("c.subedit.exr");
    expectRefused("material bake --albedo " + path("a.ppm") + " --mean-free-path " + path("b.ppm") +
                      output,
                  3, AllOf(HasSubstr("2 x 1"), HasSubstr("1 x 3")));
    expectRefused("material bake --albedo absent.png --mean-free-path 1" + output, 3,
                  HasSubstr("'absent.png'"));
    expectRefused("material bake --albedo 1.5 --mean-free-path 1" + output, 2,
                  AllOf(HasSubstr("--albedo"), HasSubstr("red is 1.5")));
    expectRefused("material bake --albedo 0.5 --mean-free-path 0" + output, 2,
                  HasSubstr("--mean-free-path"));
    expectRefused("material bake --albedo 0.5" + output, 2,
                  HasSubstr("--mean-free-path is missing"));
    std::ofstream(folder / "cut.ppm", std::ios::binary) << "P6 200 100 255\n"
                                                        << "abc";
    expectRefused("material bake --albedo " + path("cut.ppm") + " --mean-free-path 1" + output, 3,
                  HasSubstr("cut.ppm"));
}

TEST_F(Command, MaterialInfoTellsWhatAFileHolds) {
    const Outcome text = run("material info yellow_wax");
    EXPECT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, AllOf(HasSubstr("128 x 128"), HasSubstr("R_P"), HasSubstr("mm")));
    const Outcome json = run("material info yellow_wax --json");
    EXPECT_THAT(json.output, AllOf(StartsWith("{"), HasSubstr("\"segments\": 24")));
    expectRefused("material info nacre", 3, AllOf(HasSubstr("nacre"), HasSubstr("yellow_wax")));
    expectRefused("material info " + path("absent.subedit.exr"), 3, HasSubstr("no such file"));
}

TEST_F(Command, MaterialInfoWarnsOfAlbedoAboveOne) {
    writeMaterial(test::exponentialMaterial(8, 20.0f, {4.0f, 1.0f, 1.0f}, 1.0f),
                  folder / "hot.subedit.exr");
    const Outcome outcome = run("material info " + path("hot.subedit.exr"));
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.errors, HasSubstr("albedo above 1"));
}

} // namespace
} // namespace celadon::subedit
