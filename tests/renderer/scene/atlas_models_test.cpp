#include "renderer/scene/atlas.h"
#include "tests/renderer/scene/atlas_checks.h"
#include "tests/renderer/scene/atlas_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ctime>

namespace celadon {
namespace {

using namespace test;

struct Model {
    const char* file;
    int mostCharts;
    double leastCoverage;
    friend void PrintTo(const Model& model, std::ostream* os) { *os << model.file; }
};

class AtlasModels : public testing::TestWithParam<Model> {};

TEST_P(AtlasModels, FewChartsLittleDistortionGoodCoverage) {
    const char* folder = std::getenv("CELADON_MODELS");
    if (folder == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS is not set: real models were not tried";
    }
#ifndef __OPTIMIZE__
    GTEST_SKIP() << "minutes without optimization; the generated shapes carry every invariant";
#endif
    const Mesh mesh = readTestModel(std::string(folder) + "/mesh/" + GetParam().file);
    // Processor time of all threads: the machine may have other things to do.
    const std::clock_t start = std::clock();
    const Atlas atlas = expectGoodAtlas(mesh, AtlasSettings{});
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const AtlasReport& report = atlas.report;
    RecordProperty("charts", report.charts);
    EXPECT_LE(report.charts, GetParam().mostCharts);
    EXPECT_GE(report.coverage, GetParam().leastCoverage);
    EXPECT_LT(report.areaDistortionMean, 1.15);
    EXPECT_LT(report.areaDistortionMax, 3.0);
    EXPECT_LT(seconds, 40.0); // 20 s on two cores, the checks included
}

INSTANTIATE_TEST_SUITE_P(
    Files, AtlasModels,
    testing::Values(Model{"bunny_watertight_60k.obj", 20, 0.60},
                    Model{"stanford_bunny_69k_ascii.ply", 20, 0.60},
                    Model{"happy_buddha_100k.obj", 120, 0.55}, Model{"armadillo_86k.obj", 40, 0.55},
                    Model{"koala_100k.obj", 30, 0.55}, Model{"skull_genus2_100k.obj", 80, 0.55}),
    [](const auto& model) {
        std::string name = model.param.file;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

} // namespace
} // namespace celadon
