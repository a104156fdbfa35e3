// `celadon material convert|fit|import|export`, and what bake and info have besides.
#include "renderer/output/image_io.h"
#include "subedit/map/material_file.h"
#include "subedit/models/half_space.h"
#include "subedit/presets.h"
#include "subedit/radius_map.h"
#include "tests/support/command_fixture.h"
#include "tests/support/images.h"

#include <fmt/format.h>
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

class MaterialCommand : public test::CommandTest {
protected:
    MaterialCommand() : CommandTest("material") {}
};

TEST_F(MaterialCommand, BakeTakesCoefficients) {
    expectDone({"bake", "--absorption", "0.032,0.17,0.48", "--reduced-scattering", "0.74,0.88,1.01",
                "--eta", "1.3", "--roughness", "0.4", "-o", file("s.subedit.exr")});
    const MaterialMap map = readMaterial(folder / "s.subedit.exr");
    const glm::dvec3 exact = halfSpaceTotal(findMediumPreset("skin1"));
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, exact.x, 2e-3);
    EXPECT_NEAR(map.roughness.at(0), 0.4f, 1e-3f);
    expectRefused({"bake", "--absorption", "1", "-o", file("x.subedit.exr")}, 2,
                  HasSubstr("--reduced-scattering is missing"));
    expectRefused({"bake", "--absorption", "1", "--reduced-scattering", "1", "--albedo", "1", "-o",
                   file("x.subedit.exr")},
                  2, HasSubstr("more than one way"));
    expectRefused(
        {"bake", "--absorption", "-1", "--reduced-scattering", "1", "-o", file("x.subedit.exr")}, 2,
        AllOf(HasSubstr("--absorption"), HasSubstr("red is -1")));
    expectRefused({"bake", "--recipe", "jade", "--roughness", "1", "-o", file("x.subedit.exr")}, 2,
                  HasSubstr("--roughness"));
}

TEST_F(MaterialCommand, OutputsOfAnotherKindAreRefusedBeforeTheWork) {
    test::writeText(folder / "o.json", R"({"subsurface_color": [0.8, 0.5, 0.4]})");
    test::writeText(folder / "r.csv", "x_i,y_i,x_o,y_o,r\n");
    test::writeText(folder / "s.json", R"({"commands": []})");
    for (const Words& words : {Words{"bake", "--recipe", "jade"}, Words{"convert", "jade"},
                               Words{"import", file("o.json")}, Words{"fit", file("r.csv")},
                               Words{"edit", "jade", "--strokes", file("s.json")}}) {
        Words wrong = words;
        wrong.insert(wrong.end(), {"-o", file("x.png")});
        expectRefused(wrong, 2,
                      AllOf(HasSubstr(file("x.png")), HasSubstr("end it in .subedit.exr")));
        EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
        expectRefused(words, 2, HasSubstr("-o is missing"));
    }
    expectDone({"convert", "jade", "--size", "4", "-o", file("UPPER.EXR")});
    EXPECT_EQ(readMaterial(folder / "UPPER.EXR").width, 4);
}

TEST_F(MaterialCommand, BakeRespectsTheColorSpaceThatIsSaid) {
    test::writeText(folder / "a.ppm", "P6 1 1 255\n\xbc\xbc\xbc");
    const auto albedo = [&](const char* space) {
        expectDone({"bake", "--albedo", file("a.ppm"), "--albedo-space", space, "--mean-free-path",
                    "1", "-o", file("a.subedit.exr")});
        return diffuseAlbedo(profileAt(readMaterial(folder / "a.subedit.exr"), 0, 0)).x;
    };
    EXPECT_NEAR(albedo("auto"), 0.5029, 1e-3);
    EXPECT_NEAR(albedo("srgb"), 0.5029, 1e-3);
    EXPECT_NEAR(albedo("linear"), 188.0 / 255.0, 1e-3);
}

TEST_F(MaterialCommand, InfoDrawsAThumbnailAndWarns) {
    expectDone({"info", "marble_chessboard", "--thumbnail", file("t.png")});
    const FloatImage image = readImage(folder / "t.png").image;
    EXPECT_EQ(image.width, 2 * 256 + 8);
    // Light and dark squares.
    EXPECT_GT(std::abs(image.at(8, 8, 0) - image.at(24, 8, 0)), 0.2f);
    expectDone({"bake", "--albedo", "0.5", "--mean-free-path", "0.05", "--max-radius", "50", "-o",
                file("short.subedit.exr")});
    EXPECT_THAT(expectDone({"info", file("short.subedit.exr")}).err,
                HasSubstr("within the first segment"));
    expectRefused({"info", "jade", "--thumbnail", file("t.exr")}, 2, HasSubstr(".png"));
}

TEST_F(MaterialCommand, ConvertKeepsTheEnergy) {
    const ProgramResult result =
        expectDone({"convert", "jade", "--size", "20x10", "--segments", "12", "--float",
                    "--verbose", "-o", file("c.subedit.exr")});
    EXPECT_EQ(result.out, ""); // it is in the file
    EXPECT_THAT(result.err, HasSubstr("20 x 10 texels, 12 segments"));
    const MaterialMap map = readMaterial(folder / "c.subedit.exr");
    EXPECT_EQ(map.name, "jade");
    EXPECT_EQ(map.roughness.size(), 200u);
    expectRefused({"convert"}, 2, HasSubstr("no material"));
    expectRefused({"convert", "jade"}, 2, HasSubstr("-o is missing"));
    expectRefused({"convert", "jade", "--half", "--float", "-o", file("d.subedit.exr")}, 2,
                  HasSubstr("--half"));
    expectRefused({"convert", "jade", "--size", "0", "-o", file("d.subedit.exr")}, 2,
                  HasSubstr("--size"));
}

TEST_F(MaterialCommand, RefusesToOverwriteWhatItReads) {
    test::writeText(folder / "albedo.exr", "a picture");
    expectRefused(
        {"bake", "--albedo", file("albedo.exr"), "--mean-free-path", "1", "-o", file("albedo.exr")},
        2, HasSubstr("is the same file as --albedo"));
    EXPECT_EQ(test::readText(folder / "albedo.exr"), "a picture");
    expectDone({"convert", "jade", "--size", "2", "-o", file("c.subedit.exr")});
    expectRefused({"export", file("c.subedit.exr"), "-o", file("c.subedit.exr")}, 2,
                  HasSubstr("is the same file as the material"));
}

/// Pairs of a homogeneous exponential profile.
std::string responseCsv() {
    std::string csv = "u_in,v_in,u_out,v_out,r_mm,R,G,B\n";
    for (int i = 0; i < 300; ++i) {
        const double r = 0.05 * i;
        csv += fmt::format("0.2,0.5,{},0.5,{},{},{},{}\n", 0.2 + 0.01 * r, r,
                           0.02 * std::exp(-r / 2.0), 0.02 * std::exp(-r), 0.01 * std::exp(-r));
    }
    return csv;
}

TEST_F(MaterialCommand, FitFactorsATable) {
    test::writeText(folder / "r.csv", responseCsv());
    const ProgramResult result =
        expectDone({"fit", file("r.csv"), "--size", "1", "--verbose", "-o", file("r.subedit.exr")});
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, AllOf(HasSubstr("300 samples used"), HasSubstr("relative error")));
    const MaterialMap map = readMaterial(folder / "r.subedit.exr");
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 2.0 * 3.14159 * 0.02 * 4.0, 0.02);
    EXPECT_EQ(map.name, "r");
}

TEST_F(MaterialCommand, FitTakesPositionsAndPictures) {
    test::writeText(folder / "p.csv",
                    "x_in,y_in,z_in,x_out,y_out,z_out,u_in,v_in,u_out,v_out,R,G,B\n"
                    "0,0,0,3,4,0,0,0,0,0,0.1,0.1,0.1\n"
                    "0,0,0,0,0,1,0,0,0,0,0.2,0.2,0.2\n");
    expectDone(
        {"fit", file("p.csv"), "--size", "1", "--segments", "2", "-o", file("p.subedit.exr")});
    EXPECT_FLOAT_EQ(readMaterial(folder / "p.subedit.exr").maxRadiusMm, 5.0f);

    FloatImage image{33, 33, {"R", "G", "B"}, {}};
    for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 33; ++x) {
            const double r = std::hypot(x - 16, y - 16); // 33 mm wide
            image.pixels.insert(image.pixels.end(), 3, static_cast<float>(0.01 * std::exp(-r / 3)));
        }
    }
    writeExr(folder / "a.exr", image);
    test::writeText(folder / "list.csv", "file,u,v\na.exr,0.5,0.5\n");
    expectDone({"fit", "--images", file("list.csv"), "--extent", "33", "--size", "1", "-o",
                file("i.subedit.exr")});
    const MaterialMap map = readMaterial(folder / "i.subedit.exr");
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 2.0 * 3.14159 * 0.01 * 9.0, 0.05);
}

TEST_F(MaterialCommand, FitRefusesBrokenTables) {
    const auto expectTableRefused = [&](const char* text,
                                        const testing::Matcher<std::string>& says) {
        test::writeText(folder / "bad.csv", text);
        expectRefused({"fit", file("bad.csv"), "-o", file("bad.subedit.exr")}, 3,
                      AllOf(HasSubstr("bad.csv"), says));
        EXPECT_FALSE(std::filesystem::exists(folder / "bad.subedit.exr"));
    };
    expectTableRefused("", HasSubstr("no rows"));
    expectTableRefused("u_in,v_in\n1,2\n", HasSubstr("no column u_out"));
    expectTableRefused("u_in,v_in,u_out,v_out,R,G,B\n", HasSubstr("r_mm"));
    expectTableRefused("u_in,v_in,u_out,v_out,r_mm,R,G,B\n0,0,0,0,nan,1,1,1\n",
                       AllOf(HasSubstr("line 2"), HasSubstr("r_mm")));
    expectTableRefused("u_in,v_in,u_out,v_out,r_mm,R,G,B\n0,0,0,0,1,-1,1,1\n",
                       HasSubstr("negative"));
    expectTableRefused("u_in,v_in,u_out,v_out,r_mm,R,G,B\n0,0,0\n", HasSubstr("line 2"));
    expectRefused({"fit", "-o", file("x.subedit.exr")}, 2, HasSubstr("no responses"));
    expectRefused({"fit", "--images", "l.csv", "-o", file("x.subedit.exr")}, 2,
                  HasSubstr("--extent"));
}

TEST_F(MaterialCommand, ImportAndExportGoBothWays) {
    const ProgramResult out =
        expectDone({"export", "marble", "--convention", "principled", "-o", file("p.json")});
    EXPECT_THAT(out.err, HasSubstr("lost: the shape"));
    expectDone({"import", file("p.json"), "--convention", "principled", "--segments", "64", "-o",
                file("p.subedit.exr")});
    const MaterialMap map = readMaterial(folder / "p.subedit.exr");
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 0.83, 0.005);
    EXPECT_NEAR(effectiveRadiusMm(profileAt(map, 0, 0)).x, 10.57, 0.3);
    test::writeText(folder / "bad.json", "{");
    expectRefused({"import", file("bad.json"), "-o", file("x.subedit.exr")}, 3,
                  HasSubstr("is no JSON"));
    expectRefused(
        {"import", file("p.json"), "--convention", "openpbr", "-o", file("x.subedit.exr")}, 3,
        AllOf(HasSubstr("subsurface_color"), HasSubstr("is missing")));
}

TEST_F(MaterialCommand, ExportIntoAGltf) {
    test::writeText(folder / "m.gltf",
                    R"({"asset":{"version":"2.0"},"materials":[{"name":"a",
                       "pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
                       {"name":"leaf","alphaMode":"MASK",
                       "pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"meshes":[]})");
    expectDone({"bake", "--recipe", "skin1", "-o", file("skin.subedit.exr")});
    expectDone({"export", file("skin.subedit.exr"), "--convention", "gltf", "--into",
                file("m.gltf"), "--gltf-material", "a", "-o", file("out.gltf")});
    const auto document = nlohmann::json::parse(test::readText(folder / "out.gltf"));
    EXPECT_EQ(document["materials"][0]["extras"]["subedit"], "skin.subedit.exr");
    const auto& look = document["materials"][0]["pbrMetallicRoughness"];
    EXPECT_TRUE(look.contains("baseColorFactor"));
    EXPECT_FALSE(look.contains("baseColorTexture")); // or viewers would multiply the two
    expectDone({"export", file("skin.subedit.exr"), "--convention", "gltf", "--into",
                file("m.gltf"), "--gltf-material", "leaf", "-o", file("leaf.gltf")});
    const auto leaf = nlohmann::json::parse(test::readText(folder / "leaf.gltf"));
    EXPECT_TRUE(leaf["materials"][1]["pbrMetallicRoughness"].contains("baseColorTexture"));
    expectRefused({"export", "jade", "--convention", "gltf", "--into", file("m.gltf"), "-o",
                   "/tmp/elsewhere.gltf"},
                  2, HasSubstr("another folder"));
    expectRefused({"export", "jade", "--into", file("m.gltf")}, 2, HasSubstr("--into"));
    expectRefused({"export", "jade", "--convention", "gltf", "--into", file("m.gltf"), "-o",
                   file("./m.gltf")},
                  2, HasSubstr("--into"));
    const auto refusesInto = [&](const std::string& name, const std::string& says) {
        expectRefused({"export", "jade", "--convention", "gltf", "--into", file(name),
                       "--gltf-material", "hair", "-o", file("out.gltf")},
                      3, AllOf(HasSubstr("'" + file(name) + "'"), HasSubstr(says)));
    };
    refusesInto("m.gltf", "has no material 'hair' among its 2");
    test::writeText(folder / "old.gltf", R"({"asset":{"version":"1.0"}})");
    refusesInto("old.gltf", "is glTF \"1.0\", not 2.0");
    test::writeText(folder / "odd.gltf", R"({"asset":{"version":"2.0"},"materials":[7]})");
    refusesInto("odd.gltf", "is not laid out as glTF 2.0 is");
    test::writeText(folder / "none.gltf", "[]");
    refusesInto("none.gltf", "is not laid out as glTF 2.0 is");
}

} // namespace
} // namespace celadon
