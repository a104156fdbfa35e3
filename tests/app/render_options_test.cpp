#include "app/render_options.h"
#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace celadon::app {
namespace {

using test::messageOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Parsed and checked, with a model and an output that do.
RenderOptions parse(std::vector<std::string> words,
                    const std::vector<std::string>& base = {"m.obj", "-o", "a.exr"}) {
    CLI::App app;
    RenderOptions options;
    addRenderOptions(app, options);
    words.insert(words.begin(), base.begin(), base.end());
    std::reverse(words.begin(), words.end()); // as CLI11 wants them
    app.parse(words);
    validateRenderOptions(options);
    return options;
}

TEST(RenderOptions, ATableStandsForItsOwnEpsilon) {
    EXPECT_EQ(parse({"--table", "t.exr"}).table, "t.exr");
    EXPECT_THROW(parse({"--table", "t.exr", "--epsilon", "0.01"}), UsageError);
}

TEST(RenderOptions, TakeAMediumForAMaterial) {
    EXPECT_FALSE(mediumOf(parse({})));
    EXPECT_DOUBLE_EQ(mediumOf(parse({"--preset", "marble"}))->eta, 1.5);
    const RenderOptions o =
        parse({"--solver", "path-traced", "--absorption", "0.1,0.2,0.3", "--reduced-scattering",
               "1,2,3", "--g", "0.5", "--eta", "1.4", "--paths", "1000", "--noise", "0.02"});
    const subedit::Medium medium = mediumOf(o).value();
    EXPECT_EQ(medium.absorption, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(medium.reducedScattering, glm::dvec3(1, 2, 3));
    EXPECT_DOUBLE_EQ(medium.anisotropy, 0.5);
    EXPECT_DOUBLE_EQ(medium.eta, 1.4);
    EXPECT_EQ(o.paths, 1000);
    EXPECT_DOUBLE_EQ(o.noise, 0.02);
    EXPECT_EQ(pathCount(o), 1000);
    // A noise alone takes as many as it takes.
    EXPECT_EQ(pathCount(parse({"--preset", "marble"})), 4'000'000);
    EXPECT_GT(pathCount(parse({"--preset", "marble", "--noise", "0.02"})), 1'000'000'000);
}

TEST(RenderOptions, TellWhichHaveNoEffectInTheHierarchicalScheme) {
    const std::vector<std::string> all{"--alpha",         "3",   "--epsilon",       "0.1",
                                       "--discontinuity", "0.1", "--no-orientation"};
    const auto idle = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = all;
        words.insert(words.end(), more.begin(), more.end());
        return idleOptions(parse(words));
    };
    EXPECT_THAT(idle({}),
                ElementsAre("--alpha", "--epsilon", "--discontinuity", "--no-orientation"));
    EXPECT_THAT(idle({"--aov"}), ElementsAre("--alpha", "--discontinuity", "--no-orientation"));
    EXPECT_THAT(idle({"--scheme", "paper"}), ElementsAre());
    EXPECT_THAT(idleOptions(parse({"--table", "t.csv"})), ElementsAre("--table"));
    EXPECT_THAT(idleOptions(parse({"--no-adaptive", "--no-multires", "--energy", "1"})),
                ElementsAre());
    EXPECT_THAT(idleOptions(parse({"--energy", "0.9"})), ElementsAre("--energy"));
}

TEST(RenderOptions, HaveTheDocumentedDefaults) {
    const RenderOptions o = parse({});
    EXPECT_EQ(o.model, "m.obj");
    EXPECT_EQ(o.output, "a.exr");
    EXPECT_EQ(o.size, glm::ivec2(800, 600));
    EXPECT_EQ(o.toneMap, ToneMap::Neutral);
    EXPECT_FALSE(o.background.has_value());
    EXPECT_TRUE(o.specular && o.adaptive && o.multiresolution);
    EXPECT_FALSE(o.levels || o.alpha || o.epsilon || o.energy || o.discontinuity ||
                 o.irradianceSize);
    EXPECT_EQ(o.solver, Solver::Splatting);
    EXPECT_EQ(o.context, gl::ContextKind::Auto);
    EXPECT_EQ(o.exitFresnel, ExitFresnel::Exact);
}

TEST(RenderOptions, TakeEveryOption) {
    const RenderOptions o = parse({"--material",
                                   "jade",
                                   "--size",
                                   "64x32",
                                   "--samples",
                                   "8",
                                   "--exposure",
                                   "-1.5",
                                   "--tonemap",
                                   "aces",
                                   "--background",
                                   "1,0.5,0",
                                   "--no-specular",
                                   "--view-from",
                                   "-1,2,-3",
                                   "--view-at",
                                   "0,0,0",
                                   "--view-up",
                                   "0,0,1",
                                   "--fov",
                                   "45",
                                   "--diameter",
                                   "80",
                                   "--light",
                                   "directional:0,-1,0",
                                   "--light",
                                   "point:-1,2,3:5,5,5",
                                   "--environment",
                                   "sky.hdr",
                                   "--environment-lights",
                                   "16",
                                   "--animation",
                                   "walk",
                                   "--time",
                                   "1.5",
                                   "--deform",
                                   "twist:y:90",
                                   "--deform",
                                   "inflate:-2",
                                   "--solver",
                                   "image-reference",
                                   "--scheme",
                                   "hierarchical",
                                   "--quality",
                                   "final",
                                   "--backend",
                                   "raster",
                                   "--context",
                                   "osmesa",
                                   "--levels",
                                   "4,2",
                                   "--irradiance-size",
                                   "256",
                                   "--alpha",
                                   "10",
                                   "--epsilon",
                                   "0.001",
                                   "--discontinuity",
                                   "0.05",
                                   "--energy",
                                   "0.95",
                                   "--no-adaptive",
                                   "--no-multires",
                                   "--exit-fresnel",
                                   "paper",
                                   "--point-samples",
                                   "--aov",
                                   "--stats",
                                   "s.json"});
    EXPECT_EQ(o.material, "jade");
    EXPECT_EQ(o.size, glm::ivec2(64, 32));
    EXPECT_EQ(o.samples, 8);
    EXPECT_EQ(o.exposureEv, -1.5);
    EXPECT_EQ(o.toneMap, ToneMap::Aces);
    EXPECT_EQ(o.background, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(o.viewFrom, glm::dvec3(-1, 2, -3));
    EXPECT_EQ(o.viewUp, glm::dvec3(0, 0, 1));
    EXPECT_EQ(o.fovYDegrees, 45.0);
    EXPECT_EQ(o.diameterMm, 80.0);
    EXPECT_THAT(o.lights, ElementsAre("directional:0,-1,0", "point:-1,2,3:5,5,5"));
    EXPECT_EQ(o.environment, "sky.hdr");
    EXPECT_EQ(o.environmentLights, 16);
    EXPECT_FALSE(o.environmentBehind);
    EXPECT_EQ(o.animation, "walk");
    EXPECT_EQ(o.timeSeconds, 1.5);
    EXPECT_THAT(o.deformations, ElementsAre("twist:y:90", "inflate:-2"));
    EXPECT_EQ(o.solver, Solver::ImageReference);
    EXPECT_EQ(o.scheme, Scheme::Hierarchical);
    EXPECT_EQ(o.quality, Quality::Final);
    EXPECT_EQ(o.backend, SplatBackendKind::Raster);
    EXPECT_EQ(o.context, gl::ContextKind::Osmesa);
    EXPECT_EQ(o.levels->irradiance, 4);
    EXPECT_EQ(o.levels->splatting, 2);
    EXPECT_EQ(o.irradianceSize, 256);
    EXPECT_EQ(o.alpha, 10.0);
    EXPECT_EQ(o.epsilon, 0.001);
    EXPECT_EQ(o.discontinuity, 0.05);
    EXPECT_EQ(o.energy, 0.95);
    EXPECT_EQ(o.exitFresnel, ExitFresnel::Paper);
    EXPECT_FALSE(o.specular || o.adaptive || o.multiresolution);
    EXPECT_TRUE(o.pointSamples && o.aov);
    EXPECT_EQ(o.stats, "s.json");
}

TEST(RenderOptions, LetTheLastOfSeveralCount) {
    EXPECT_EQ(parse({"--size", "1x1", "--size", "2x2"}).size, glm::ivec2(2, 2));
    EXPECT_FALSE(
        parse({"--background", "1,1,1", "--background", "transparent"}).background.has_value());
}

TEST(RenderOptions, NumberFrames) {
    const RenderOptions o =
        parse({"--frames", "3:5", "--fps", "30"}, {"m.glb", "-o", "f_%03d.png"});
    EXPECT_EQ(o.frames->count(), 3);
    EXPECT_EQ(o.framesPerSecond, 30.0);
    EXPECT_EQ(outputOfFrame(o, 4), "f_004.png");
    EXPECT_EQ(outputOfFrame(parse({}), 4), "a.exr");
}

TEST(RenderOptions, TakeASequenceForTheModel) {
    const RenderOptions o =
        parse({"--sequence", "f_%04d.ply", "--frames", "1:2", "-o", "o%d.exr"}, {});
    EXPECT_EQ(o.sequence, "f_%04d.ply");
}

/// Word lists that must be refused, and a word of the message.
struct Refusal {
    std::vector<std::string> words;
    const char* says;
    std::vector<std::string> base{"m.obj", "-o", "a.exr"};
};

class Refused : public testing::TestWithParam<Refusal> {};

TEST_P(Refused, WithAMessageThatNamesIt) {
    const Refusal& refusal = GetParam();
    EXPECT_THAT(messageOf<UsageError>([&] { parse(refusal.words, refusal.base); }),
                HasSubstr(refusal.says));
}

INSTANTIATE_TEST_SUITE_P(
    RenderOptions, Refused,
    testing::Values(
        Refusal{{}, "no model", {"-o", "a.exr"}}, Refusal{{}, "no output", {"m.obj"}},
        Refusal{{}, ".bmp", {"m.obj", "-o", "a.bmp"}},
        Refusal{{"--aov"}, "--aov", {"m.obj", "-o", "a.png"}},
        Refusal{{"--scale", "1", "--diameter", "2"}, "--diameter"},
        Refusal{{"--scale", "0"}, "--scale"}, Refusal{{"--fov", "180"}, "--fov"},
        Refusal{{"--view-up", "0,0,0"}, "--view-up"},
        Refusal{{"--view-from", "1,1,1", "--view-at", "1,1,1"}, "--view-at"},
        Refusal{{"--view-from", "0,5,0", "--view-at", "0,0,0", "--view-up", "0,1,0"}, "--view-up"},
        Refusal{{"--frames", "1:3"}, "%04d"}, Refusal{{}, "--frames", {"m.obj", "-o", "a%04d.exr"}},
        Refusal{{"--material", "m%04d.subedit.exr"}, "--material"},
        Refusal{{"--frames", "1:3", "--time", "1"}, "--time", {"m.obj", "-o", "a%d.exr"}},
        Refusal{
            {"--sequence", "f%d.ply", "--frames", "1:2"}, "--sequence", {"m.obj", "-o", "a%d.exr"}},
        Refusal{{"--sequence", "f%d.ply"}, "--frames", {"-o", "a.exr"}},
        Refusal{{"--energy", "1.01"}, "--energy"}, Refusal{{"--samples", "0"}, "--samples"},
        Refusal{{"--levels", "0"}, "--levels"},
        Refusal{{"--background", "environment"}, "no environment"},
        Refusal{{"--background", "white"}, "--background"}, Refusal{{"--context", "vulkan"}, "egl"},
        Refusal{{"--solver", "x"}, "path-traced"}, Refusal{{"--solver", "path-traced"}, "--preset"},
        Refusal{{"--solver", "path-traced", "--material", "marble"}, "--preset"},
        Refusal{{"--preset", "marble", "--material", "marble"}, "--material"},
        Refusal{{"--absorption", "1,1,1"}, "--reduced-scattering"},
        Refusal{{"--preset", "granite"}, "marble"}, Refusal{{"--noise", "-1"}, "--noise"},
        Refusal{{"--size", "16384x16384"}, "--size"}, Refusal{{"--alpha", "nan"}, "--alpha"}));

} // namespace
} // namespace celadon::app
