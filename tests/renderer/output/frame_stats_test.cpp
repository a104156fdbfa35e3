#include "renderer/output/frame_stats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace celadon {
namespace {

using Json = nlohmann::ordered_json;

RenderStats example() {
    RenderStats stats;
    stats.contextKind = "egl";
    stats.contextRenderer = "llvmpipe";
    stats.contextVersion = "4.5";
    stats.solver = "splatting";
    stats.scheme = "paper";
    stats.backend = "raster";
    stats.width = 800;
    stats.height = 600;
    stats.irradianceSize = 512;
    stats.irradianceLevels = 3;
    stats.splattingLevels = 3;
    FrameStats frame;
    frame.frame = 1;
    frame.milliseconds.splatting = {1.0, 2.0, 3.0};
    frame.samples.candidates = 5'000'000'000ull;
    frame.samples.selected = {10, 20};
    frame.flux.lit = {0.5, 0.25, 0.125};
    frame.effectiveRadius.meanMm = 2.5;
    stats.frames.push_back(frame);
    return stats;
}

std::vector<std::string> keys(const Json& json) {
    std::vector<std::string> names;
    for (const auto& item : json.items()) {
        names.push_back(item.key());
    }
    return names;
}

TEST(FrameStats, HasTheKeysInTheirOrder) {
    const Json json = Json::parse(toJson(example()));
    using testing::ElementsAre;
    EXPECT_THAT(keys(json),
                ElementsAre("context", "solver", "scheme", "backend", "size", "irradianceSize",
                            "levels", "millimetresPerUnit", "frames"));
    EXPECT_THAT(keys(json["context"]), ElementsAre("kind", "renderer", "version"));
    const Json& frame = json["frames"][0];
    EXPECT_THAT(keys(frame),
                ElementsAre("frame", "milliseconds", "samples", "flux", "effectiveRadius"));
    EXPECT_THAT(keys(frame["milliseconds"]),
                ElementsAre("deformation", "irradianceBuffer", "splattingBuffer", "selection",
                            "splatting", "accumulation", "shading", "total"));
    EXPECT_THAT(keys(frame["samples"]), ElementsAre("candidates", "selected", "pairs"));
    EXPECT_THAT(keys(frame["flux"]), ElementsAre("lit", "selected"));
    EXPECT_THAT(keys(frame["effectiveRadius"]), ElementsAre("min", "mean", "max", "pixels"));
}

TEST(FrameStats, KeepsValues) {
    const Json json = Json::parse(toJson(example()));
    EXPECT_EQ(json["size"], Json::array({800, 600}));
    EXPECT_EQ(json["levels"], 3);
    EXPECT_EQ(json["frames"][0]["samples"]["candidates"], 5'000'000'000ull);
    EXPECT_EQ(json["frames"][0]["samples"]["selected"], Json::array({10, 20}));
    EXPECT_EQ(json["frames"][0]["flux"]["lit"], Json::array({0.5, 0.25, 0.125}));
    EXPECT_EQ(json["frames"][0]["effectiveRadius"]["mean"], 2.5);
}

TEST(FrameStats, NamesBothLevelCountsWhereTheyDiffer) {
    RenderStats stats = example();
    stats.irradianceLevels = 6;
    stats.splattingLevels = 5;
    EXPECT_EQ(Json::parse(toJson(stats))["levels"], Json::array({6, 5}));
}

TEST(FrameStats, HasTheErrorOfAReferenceWhereOneWasMeasured) {
    RenderStats stats = example();
    EXPECT_FALSE(Json::parse(toJson(stats))["frames"][0].contains("reference"));
    stats.frames[0].reference = {0.02, 1000, 0.5};
    const Json json = Json::parse(toJson(stats))["frames"][0]["reference"];
    EXPECT_EQ(json["relativeError"], 0.02);
    EXPECT_EQ(json["paths"], 1000);
    EXPECT_EQ(json["lostFlux"], 0.5);
}

TEST(FrameStats, TurnsInfinitiesAndNaNIntoNull) {
    RenderStats stats = example();
    stats.frames[0].milliseconds.total = std::numeric_limits<double>::infinity();
    stats.frames[0].flux.selected[1] = std::numeric_limits<double>::quiet_NaN();
    const Json json = Json::parse(toJson(stats));
    EXPECT_TRUE(json["frames"][0]["milliseconds"]["total"].is_null());
    EXPECT_TRUE(json["frames"][0]["milliseconds"]["deformation"].is_null()); // never measured
    EXPECT_TRUE(json["frames"][0]["flux"]["selected"][1].is_null());
}

TEST(FrameStats, SurvivesDriverNamesThatAreNoUtf8) {
    RenderStats stats = example();
    stats.contextRenderer = "GPU \xff\xfe";
    EXPECT_TRUE(Json::accept(toJson(stats)));
}

} // namespace
} // namespace celadon
