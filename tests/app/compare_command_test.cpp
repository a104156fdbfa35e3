#include "renderer/output/image_io.h"
#include "tests/support/images.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

using test::noiseImage;
using test::ProgramResult;
using test::readText;
using test::runInProcess;
using test::TemporaryFolder;
using test::uniformImage;
using test::writeText;
using testing::HasSubstr;
using Json = nlohmann::json;

const std::vector<std::string> kRgba{"R", "G", "B", "A"};

class CompareCommand : public testing::Test {
protected:
    std::string file(const char* name) const { return (folder / name).string(); }
    std::string exr(const char* name, const FloatImage& image) const {
        writeExr(folder / name, image);
        return file(name);
    }
    std::string gray(const char* name, float value) const {
        return exr(name, uniformImage(32, 32, kRgba, {value, value, value, 1.0f}));
    }

    TemporaryFolder folder;
};

TEST_F(CompareCommand, IsExactOnEqualPictures) {
    const std::string a = exr("a.exr", noiseImage(32, 24, kRgba, 1));
    const ProgramResult result = runInProcess({"compare", a, a, "--json", "--metric", "all"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const Json json = Json::parse(result.out);
    for (const char* metric : {"rmse", "relativeRmse", "flip", "flipHdr", "mean", "max", "p50",
                               "p95", "p99", "alphaRmse"}) {
        EXPECT_EQ(json.at(metric), 0.0) << metric;
    }
    EXPECT_EQ(json.at("ssim"), 1.0);
    EXPECT_EQ(json.at("meanRatio"), 1.0);
    EXPECT_TRUE(json.at("psnr").is_null());
    EXPECT_EQ(json.at("size"), Json::array({32, 24}));
}

TEST_F(CompareCommand, MeasuresLinearValuesOfExr) {
    const ProgramResult result =
        runInProcess({"compare", gray("a.exr", 0.6f), gray("b.exr", 0.5f), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_NEAR(json.at("rmse").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(json.at("relativeRmse").get<double>(), 0.2, 1e-6);
    EXPECT_NEAR(json.at("psnr").get<double>(), 20.0, 1e-4);
    EXPECT_NEAR(json.at("meanRatio").get<double>(), 1.2, 1e-6);
    EXPECT_EQ(json.at("values"), "linear");
    EXPECT_FALSE(json.contains("flipHdr"));
}

TEST_F(CompareCommand, MeasuresStoredValuesOfPng) {
    writeDisplayImage(folder / "a.png", uniformImage(16, 16, {"R", "G", "B"}, {0.2f, 0.2f, 0.2f}));
    writeDisplayImage(folder / "b.png", uniformImage(16, 16, {"R", "G", "B"}, {0.4f, 0.4f, 0.4f}));
    const ProgramResult result = runInProcess({"compare", file("a.png"), file("b.png"), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_NEAR(json.at("rmse").get<double>(), 0.2, 1e-5);
    EXPECT_EQ(json.at("values"), "display");
    EXPECT_EQ(runInProcess({"compare", file("a.png"), file("b.png"), "--metric", "all"}).exitCode,
              0);
}

TEST_F(CompareCommand, PrintsOnlyTheMetricsAskedFor) {
    const ProgramResult result =
        runInProcess({"compare", gray("a.exr", 0.6f), gray("b.exr", 0.5f), "--metric",
                      "relative-rmse,max", "--metric", "RMSE"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
    EXPECT_THAT(result.out, HasSubstr("relativeRmse  0.2"));
}

TEST_F(CompareCommand, FailsAboveALimit) {
    const std::string a = gray("a.exr", 0.6f);
    const std::string b = gray("b.exr", 0.5f);
    EXPECT_EQ(runInProcess({"compare", a, b, "--fail-above", "rmse=0.11"}).exitCode, 0);
    const ProgramResult result = runInProcess({"compare", a, b, "--fail-above", "rmse=0.09"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("above the limit 0.09"));
    EXPECT_EQ(result.errorLines(), 1);
    EXPECT_THAT(result.out, HasSubstr("rmse"));
    EXPECT_EQ(runInProcess({"compare", a, b, "--fail-below", "psnr=30"}).exitCode, 1);
    EXPECT_EQ(runInProcess({"compare", a, a, "--fail-below", "psnr=30"}).exitCode, 0);
}

TEST_F(CompareCommand, ComparesALayer) {
    const std::vector<std::string> names{"R",          "G",          "B",          "A",
                                         "exitance.R", "exitance.G", "exitance.B", "radius"};
    const std::string a = exr("a.exr", uniformImage(16, 16, names, {0, 0, 0, 1, 2, 2, 2, 5}));
    const std::string b = exr("b.exr", uniformImage(16, 16, names, {0, 0, 0, 1, 1, 1, 1, 4}));
    const ProgramResult exitance = runInProcess({"compare", a, b, "--json", "--layer", "exitance"});
    ASSERT_EQ(exitance.exitCode, 0) << exitance.err;
    EXPECT_NEAR(Json::parse(exitance.out).at("meanRatio").get<double>(), 2.0, 1e-6);
    const ProgramResult radius = runInProcess({"compare", a, b, "--json", "--layer", "radius"});
    ASSERT_EQ(radius.exitCode, 0) << radius.err;
    EXPECT_FALSE(Json::parse(radius.out).contains("flip"));
    EXPECT_EQ(runInProcess({"compare", a, b, "--layer", "radius", "--metric", "flip"}).exitCode, 3);
    const ProgramResult missing = runInProcess({"compare", a, b, "--layer", "normal"});
    EXPECT_EQ(missing.exitCode, 3);
    EXPECT_THAT(missing.err, HasSubstr("exitance.R"));
}

TEST_F(CompareCommand, DrawsAHeatMap) {
    const ProgramResult result = runInProcess(
        {"compare", gray("a.exr", 0.9f), gray("b.exr", 0.1f), "--heatmap", file("heat.png")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const FloatImage heat = readImage(folder / "heat.png").image;
    EXPECT_EQ(heat.width, 32);
    EXPECT_GT(heat.at(5, 5, 0), 0.2f);
}

TEST_F(CompareCommand, WritesItsNumbersToAFile) {
    const std::string a = gray("a.exr", 0.9f);
    const ProgramResult result = runInProcess({"compare", a, a, "--json", "-o", file("n.json")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(Json::accept(readText(folder / "n.json")));
}

TEST_F(CompareCommand, RefusesToOverwriteWhatItReads) {
    const std::string a = file("a.png");
    writeDisplayImage(a, noiseImage(32, 32, {"R", "G", "B"}, 1));
    const std::string before = readText(folder / "a.png");
    for (const char* option : {"--heatmap", "--output"}) {
        const ProgramResult result = runInProcess({"compare", a, a, option, a});
        EXPECT_EQ(result.exitCode, 2);
        EXPECT_THAT(result.err, HasSubstr("is the same file as A"));
    }
    EXPECT_EQ(readText(folder / "a.png"), before);
}

TEST_F(CompareCommand, RefusesPicturesThatDoNotMatch) {
    const std::string a = gray("a.exr", 0.5f);
    const auto refused = [&](const std::string& other, const char* says) {
        const ProgramResult result = runInProcess({"compare", a, other});
        EXPECT_EQ(result.exitCode, 3) << other;
        EXPECT_THAT(result.err, HasSubstr(says));
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_EQ(result.out, "");
    };
    refused(exr("small.exr", uniformImage(8, 8, kRgba, {0, 0, 0, 1})), "32x32 and 8x8");
    refused(exr("gray.exr", uniformImage(32, 32, {"Y"}, {0})), "channels differ");
    refused(exr("depth.exr", uniformImage(32, 32, {"Z"}, {0})), "no color");
    FloatImage bad = uniformImage(32, 32, kRgba, {0, 0, 0, 1});
    bad.at(3, 4, 1) = std::numeric_limits<float>::quiet_NaN();
    refused(exr("nan.exr", bad), "channel G at pixel 3,4");
    refused(file("none.exr"), "no such file");
    writeText(folder / "text.png", "hello");
    refused(file("text.png"), "text.png");
    const std::string png = readText(folder / "a.exr");
    writeText(folder / "cut.exr", std::string_view(png).substr(0, png.size() / 2));
    refused(file("cut.exr"), "cut.exr");
    writeDisplayImage(folder / "whole.png", noiseImage(32, 32, {"R", "G", "B"}, 1));
    const std::string bytes = readText(folder / "whole.png");
    writeText(folder / "cut.png", std::string_view(bytes).substr(0, bytes.size() / 2));
    refused(file("cut.png"), "cut.png");
}

TEST_F(CompareCommand, SaysWhichMetricIsUndefined) {
    const std::string a = gray("a.exr", 0.5f);
    const std::string black = gray("b.exr", 0.0f);
    const ProgramResult all = runInProcess({"compare", a, black, "--json"});
    EXPECT_EQ(all.exitCode, 0) << all.err;
    EXPECT_THAT(all.err, HasSubstr("relativeRmse is undefined"));
    EXPECT_TRUE(Json::parse(all.out).at("relativeRmse").is_null());
    for (const char* option : {"--metric", "--fail-above"}) {
        const ProgramResult asked = runInProcess(
            {"compare", a, black, option,
             std::string(option) == "--metric" ? "relative-rmse" : "relative-rmse=0.1"});
        EXPECT_EQ(asked.exitCode, 3) << option;
        EXPECT_THAT(asked.err, HasSubstr("all zero"));
        EXPECT_EQ(asked.errorLines(), 1) << asked.err;
        EXPECT_EQ(asked.out, "");
    }
    EXPECT_EQ(runInProcess({"compare", black, black, "--metric", "relative-rmse"}).exitCode, 0);
}

TEST_F(CompareCommand, WarnsWhereOneHasNoAlpha) {
    const std::string a = gray("a.exr", 0.5f);
    const std::string b = exr("b.exr", uniformImage(32, 32, {"R", "G", "B"}, {0.5f, 0.5f, 0.5f}));
    const ProgramResult result = runInProcess({"compare", a, b, "--json"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.err, HasSubstr("warning"));
    EXPECT_EQ(Json::parse(result.out).at("alphaRmse"), 0.0);
}

} // namespace
} // namespace celadon
