// `celadon profile`: what its subcommands write, and how they refuse.
#include "renderer/output/image_io.h"
#include "subedit/fit/measured_curve.h"
#include "subedit/map/material_file.h"
#include "subedit/map/range_table_file.h"
#include "subedit/models/half_space.h"
#include "subedit/radius_map.h"
#include "tests/support/command_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace celadon {
namespace {

using namespace subedit;
using test::ProgramResult;
using test::runInProcess;
using test::Words;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ProfileCommand : public test::CommandTest {
protected:
    ProfileCommand() : CommandTest("profile") {}
};

const Words kMedium{"--absorption", "0.05", "--reduced-scattering", "0.95", "--eta", "1.4"};

Words make(const Words& more) {
    Words words{"make"};
    words.insert(words.end(), kMedium.begin(), kMedium.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST_F(ProfileCommand, EveryModelMakesATableOfAboutTheExactAlbedo) {
    const double exact = halfSpaceTotal(0.95, 1.4);
    for (const char* model : {"dipole", "better-dipole", "quantized", "photon-beam",
                              "normalized-diffusion", "monte-carlo"}) {
        const ProgramResult result = expectDone(make({"--model", model, "--samples", "20000"}));
        EXPECT_THAT(result.out, StartsWith("r_mm,R,G,B"));
        const RadialCurves curves = measuredCurves(parseProfileCsv(result.out, model));
        EXPECT_NEAR(curves[0].total, exact, 0.15 * exact) << model;
    }
}

TEST_F(ProfileCommand, MonteCarloGivesItsErrorsAndRepeatsItself) {
    const Words words =
        make({"--model", "monte-carlo", "--samples", "5000", "--seed", "3", "--g", "0.5"});
    const ProgramResult first = expectDone(words);
    EXPECT_THAT(first.out, StartsWith("r_mm,R,G,B,R_error,G_error,B_error\n"));
    EXPECT_EQ(first.out, expectDone(words).out);
    const ProgramResult diffuse =
        expectDone(make({"--model", "monte-carlo", "--samples", "5000", "--entry", "diffuse"}));
    EXPECT_NE(first.out, diffuse.out);
}

TEST_F(ProfileCommand, SigmaSWithGIsSigmaSPrime) {
    const ProgramResult reduced =
        expectDone({"make", "--absorption", "0.1", "--reduced-scattering", "1"});
    const ProgramResult full =
        expectDone({"make", "--absorption", "0.1", "--scattering", "5", "--g", "0.8"});
    EXPECT_EQ(parseProfileCsv(reduced.out, "a").value[9][0],
              parseProfileCsv(full.out, "b").value[9][0]);
}

TEST_F(ProfileCommand, SurfaceAlbedoIsInverted) {
    expectDone({"make", "--surface-albedo", "0.8,0.5,0.2", "--mean-free-path", "1", "--model",
                "photon-beam", "-o", file("p.subedit.exr")});
    const glm::dvec3 albedo =
        diffuseAlbedo(profileAt(readMaterial(folder / "p.subedit.exr"), 0, 0));
    EXPECT_NEAR(albedo.x, 0.8, 0.04); // the model's own excess
    EXPECT_NEAR(albedo.z, 0.2, 0.02);
}

TEST_F(ProfileCommand, MakeRefusesOptionsThatDoNotGoTogether) {
    expectRefused(make({"--entry", "diffuse"}), 2, HasSubstr("monte-carlo"));
    expectRefused(make({"--fit", "dmfp"}), 2, HasSubstr("normalized diffusion"));
    expectRefused(make({"--g", "1"}), 2, HasSubstr("--g"));
    expectRefused(make({"--g", "-1.5"}), 2, HasSubstr("--g"));
    expectRefused(make({"--samples", "0"}), 2, HasSubstr("--samples"));
    expectRefused(make({"--eta", "3.9"}), 2, HasSubstr("dipole"));
    expectRefused(make({"--model", "magic"}), 2, HasSubstr("photon-beam"));
    expectRefused(make({"--scattering", "1"}), 2, HasSubstr("both given"));
    expectRefused(make({"--mean-free-path", "1"}), 2, HasSubstr("more than one way"));
    expectRefused({"make", "--mean-free-path", "1"}, 2, HasSubstr("--albedo is missing"));
    expectRefused({"make", "--surface-albedo", "1.2", "--mean-free-path", "1"}, 2,
                  HasSubstr("--surface-albedo"));
}

TEST_F(ProfileCommand, FitKeepsTheAlbedoAndReportsItsError) {
    for (const char* model : {"dipole", "photon-beam", "normalized-diffusion"}) {
        expectDone(make({"--model", model, "-o", file("p.csv")}));
        const ProgramResult result =
            expectDone({"fit", file("p.csv"), "-o", file("p.subedit.exr")});
        EXPECT_EQ(result.out, ""); // it is in the file
        EXPECT_EQ(result.err, "");
        EXPECT_THAT(expectDone({"fit", file("p.csv")}).out,
                    AllOf(HasSubstr("rms error"), HasSubstr("misplaced")));
        const double total = measuredCurves(readProfileCsv(folder / "p.csv"))[0].total;
        const MaterialMap map = readMaterial(folder / "p.subedit.exr");
        EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x / total, 1.0, 1e-3) << model;
        EXPECT_EQ(map.name, "p");
    }
}

TEST_F(ProfileCommand, MakeLeavesStdoutToResults) {
    const ProgramResult quiet = expectDone(make({"-o", file("p.subedit.exr")}));
    EXPECT_EQ(quiet.out + quiet.err, "");
    const ProgramResult verbose = expectDone(make({"-o", file("p.subedit.exr"), "--verbose"}));
    EXPECT_EQ(verbose.out, "");
    EXPECT_THAT(verbose.err, HasSubstr("rms error"));
}

TEST_F(ProfileCommand, FitRefusesWhatIsNoTable) {
    test::writeText(folder / "bad.csv", "r_mm,R,G,B\n2,1,1,1\n1,1,1,1\n");
    expectRefused({"fit", file("bad.csv")}, 3, AllOf(HasSubstr("bad.csv"), HasSubstr("line 3")));
    expectRefused({"fit", file("absent.csv")}, 3, HasSubstr("no such file"));
    test::writeText(folder / "empty.csv", "");
    expectRefused({"fit", file("empty.csv")}, 3, HasSubstr("empty.csv"));
    expectRefused({"fit"}, 2, HasSubstr("no table"));
}

TEST_F(ProfileCommand, FitWarnsOfAnAlbedoAboveOne) {
    test::writeText(folder / "hot.csv", "0,1\n1,1\n2,1\n");
    const ProgramResult result = expectDone({"fit", file("hot.csv")});
    EXPECT_THAT(result.err, HasSubstr("albedo of 12.57"));
}

TEST_F(ProfileCommand, TablesOfSeveralMaterialsAndRanges) {
    const ProgramResult one = expectDone({"table", "marble"});
    const ProgramResult both = expectDone({"table", "marble", "jade", "--t-range", "4:64",
                                           "--entries-per-octave", "2", "--epsilon", "0.05"});
    EXPECT_THAT(both.out, HasSubstr("\nT,minimalRadius\n4,"));
    EXPECT_EQ(parseTableCsv(both.out, "x").T.size(), 9u);
    EXPECT_EQ(parseTableCsv(one.out, "x").T.size(), 97u);
    expectDone({"table", "marble", "-o", file("t.exr")});
    EXPECT_NEAR(readTable(folder / "t.exr").epsilon, 0.01, 1e-6);
    expectDone({"table", "marble", "-o", file("t.svg")});
    EXPECT_THAT(test::readText(folder / "t.svg"), HasSubstr("Mean profile of marble"));
    expectRefused({"table"}, 2, HasSubstr("no material"));
    expectDone(make({"-o", file("m.subedit.exr")}));
    expectRefused({"table", file("m.subedit.exr"), "-o", file("m.subedit.exr")}, 2,
                  HasSubstr("is the same file as a material"));
    expectRefused({"table", "marble", "--t-range", "8:2"}, 2, HasSubstr("--t-range"));
    expectRefused({"table", "marble", "--t-range", "8"}, 2, HasSubstr("--t-range"));
    expectRefused({"table", "marble", "-o", file("t.txt")}, 2, HasSubstr(".csv"));
}

TEST_F(ProfileCommand, PlotsAreDrawn) {
    expectDone(make({"-o", file("p.csv")}));
    expectDone({"plot", "Mine=" + file("p.csv"), "marble", "--ratio", "-o", file("p.svg")});
    EXPECT_THAT(test::readText(folder / "p.svg"),
                AllOf(HasSubstr("Mine, red"), HasSubstr("marble, blue"), HasSubstr("95 %")));
    expectDone({"plot", "jade", "--uv", "0.1,0.9", "--energy", "0.9", "-o", file("p.png")});
    EXPECT_EQ(readImage(folder / "p.png").image.height, 960);
    expectDone({"plot", "marble", "--channels", "r", "--no-energy", "-o", file("r.svg")});
    EXPECT_THAT(test::readText(folder / "r.svg"), HasSubstr("R\u209a 10.6 mm"));
    expectRefused({"plot"}, 2, HasSubstr("no profile"));
    expectRefused({"plot", "marble"}, 2, HasSubstr("-o is missing"));
    expectRefused({"plot", "marble", "-o", file("p.jpg")}, 2, HasSubstr(".png"));
    expectRefused({"plot", "marble", "--channels", "x", "-o", file("p.png")}, 2,
                  HasSubstr("r, g, b"));
}

TEST_F(ProfileCommand, LutFollowsItsMapping) {
    const ProgramResult result =
        expectDone({"lut", "-o", file("l.exr"), "--size", "8x4", "--segments", "16",
                    "--mean-free-path", "0.5:8", "--verbose"});
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("0.5 mm * 16^((y + 1/2) / height)"));
    const FloatImage image = readImage(folder / "l.exr").image;
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            // The stored profile integrates to the texel's albedo.
            MaterialMap texel;
            texel.segments = 16;
            texel.maxRadiusMm = image.at(x, y, image.channelIndex("maxRadius"));
            for (int k = 0; k <= 16; ++k) {
                const float value = image.at(x, y,
                                             image.channelIndex(k < 10 ? "P00" + std::to_string(k)
                                                                       : "P0" + std::to_string(k)));
                texel.logProfile.insert(texel.logProfile.end(), 3, value);
            }
            texel.width = texel.height = 1;
            const double albedo = diffuseAlbedo(profileAt(texel, 0, 0)).x;
            EXPECT_NEAR(albedo, (x + 0.5) / 8.0, 1e-3);
            EXPECT_NEAR(image.at(x, y, image.channelIndex("total")), albedo, 1e-3);
        }
    }
    const int radius = image.channelIndex("radius95");
    EXPECT_NEAR(image.at(3, 1, radius) / image.at(3, 0, radius), 2.0f, 1e-3f);
    expectRefused({"lut"}, 2, HasSubstr("-o is missing"));
    expectRefused({"lut", "-o", file("l.exr"), "--mean-free-path", "3:1"}, 2,
                  HasSubstr("does not rise"));
}

TEST_F(ProfileCommand, ListFindsMedia) {
    EXPECT_THAT(expectDone({"list"}).out, AllOf(HasSubstr("marble"), HasSubstr("chicken2")));
    const auto found = nlohmann::json::parse(expectDone({"list", "MILK", "--json"}).out);
    EXPECT_EQ(found.size(), 9u); // two of Jensen et al., seven of Narasimhan et al.
    EXPECT_EQ(nlohmann::json::parse(expectDone({"list", "jensen", "--json"}).out).size(), 12u);
    EXPECT_EQ(expectDone({"list", "unobtainium", "--json"}).out, "[]\n");
}

} // namespace
} // namespace celadon
