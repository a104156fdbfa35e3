#include "app/plot/chart.h"
#include "app/plot/font.h"
#include "app/plot/rasterize.h"
#include "app/plot/scale.h"
#include "app/plot/svg.h"
#include "app/plot/write_plot.h"
#include "renderer/output/image_io.h"
#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon::plot {
namespace {

using testing::HasSubstr;
using testing::Not;

LineChart exampleChart() {
    LineChart chart{"A < B & C", {"x", false, {}, {}}, {"y", true, {}, {}}, {}};
    Series series{"curve", {}, seriesColor(1)};
    for (int i = 0; i <= 20; ++i) {
        series.points.emplace_back(i, std::exp(-0.3 * i));
    }
    chart.series.push_back(series);
    chart.markers.push_back({5.0, "mark"});
    return chart;
}

std::vector<std::string> labels(const Scale& scale) {
    std::vector<std::string> texts;
    for (const Tick& tick : scale.ticks()) {
        if (!tick.label.empty()) {
            texts.push_back(tick.label);
        }
    }
    return texts;
}

TEST(Scale, TicksAreRoundNumbersWithinTheAxis) {
    const std::vector<double> values{0.0, 7.3};
    const Scale linear({"", false, {}, {}}, values, 0.0, 100.0, true);
    EXPECT_THAT(labels(linear), testing::ElementsAre("0", "1", "2", "3", "4", "5", "6", "7", "8"));
    EXPECT_DOUBLE_EQ(linear.place(4.0), 50.0);
    const std::vector<double> decades{3e-5, 40.0};
    const Scale logarithmic({"", true, {}, {}}, decades, 0.0, 70.0, true);
    EXPECT_THAT(labels(logarithmic),
                testing::ElementsAre("10⁻⁵", "10⁻⁴", "10⁻³", "0.01", "0.1", "1", "10", "100"));
    EXPECT_NEAR(logarithmic.place(0.01), 30.0, 1e-9);
    EXPECT_FALSE(logarithmic.canShow(0.0));
}

TEST(Scale, NothingToShowIsNoTrouble) {
    for (const bool isLogarithmic : {false, true}) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        for (const std::vector<double>& values :
             {std::vector<double>{}, {nan}, {5.0}, {0.0, 0.0}, {-3.0}, {1e300, 1e-300}}) {
            const Scale scale({"", isLogarithmic, {}, {}}, values, 0.0, 1.0, true);
            EXPECT_LT(scale.from(), scale.to());
            EXPECT_LT(scale.ticks().size(), 10000u);
        }
    }
}

TEST(Chart, LinesStayWithinTheAxes) {
    LineChart chart = exampleChart();
    chart.series[0].points.emplace_back(1e6, 1e30); // far outside
    chart.series[0].points.emplace_back(3.0, std::numeric_limits<double>::infinity());
    chart.series[0].points.emplace_back(3.0, -1.0); // not on a logarithmic axis
    chart.x.to = 20.0;
    chart.y.from = 1e-3;
    chart.y.to = 1.0;
    for (const Shape& shape : drawChart(chart).shapes) {
        if (const auto* stroke = std::get_if<Stroke>(&shape)) {
            for (const glm::dvec2& point : stroke->points) {
                EXPECT_TRUE(point.x >= 0.0 && point.x <= chart.size.x) << point.x;
                EXPECT_TRUE(point.y >= 0.0 && point.y <= chart.size.y) << point.y;
            }
        }
    }
}

TEST(Svg, TextIsEscapedAndStaysText) {
    const std::string svg = toSvg(drawChart(exampleChart()));
    EXPECT_THAT(svg, HasSubstr(">A &lt; B &amp; C</text>"));
    EXPECT_THAT(svg, HasSubstr(">curve</text>"));
    EXPECT_THAT(svg, HasSubstr("</svg>"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Font, WordsHaveWidthsAndOutlines) {
    EXPECT_GT(textWidth("mm", 12.0), textWidth("ii", 12.0));
    EXPECT_NEAR(textWidth("abc", 24.0), 2.0 * textWidth("abc", 12.0), 1e-3);
    EXPECT_EQ(textWidth("", 12.0), 0.0);
    EXPECT_GE(textOutlines("i", 12.0).size(), 2u); // stem and dot
    EXPECT_GT(textWidth("\xff\xc3", 12.0), 0.0);   // broken UTF-8
}

TEST(Rasterize, FillsCoverWhatTheyShould) {
    Drawing drawing{{10.0, 10.0}, {}};
    drawing.shapes.emplace_back(
        Fill{{{2.0, 2.0}, {6.5, 2.0}, {6.5, 5.0}, {2.0, 5.0}}, Color(0.0f)});
    const FloatImage image = rasterize(drawing, 1.0);
    EXPECT_FLOAT_EQ(image.at(3, 3, 0), 0.0f);
    EXPECT_NEAR(image.at(6, 3, 0), 0.5f, 1e-3f);
    EXPECT_FLOAT_EQ(image.at(8, 8, 0), 1.0f);
    double dark = 0.0;
    for (const float value : image.pixels) {
        dark += 1.0 - static_cast<double>(value);
    }
    EXPECT_NEAR(dark / 3.0, 4.5 * 3.0, 1e-3);
}

TEST(Rasterize, DashesLeaveGapsAndCrossingsDoNotCancel) {
    Drawing drawing{{40.0, 10.0}, {}};
    drawing.shapes.emplace_back(Stroke{{{0.0, 5.0}, {40.0, 5.0}}, Color(0.0f), 2.0, {5.0, 5.0}});
    FloatImage image = rasterize(drawing, 1.0);
    EXPECT_LT(image.at(2, 5, 0), 0.01f);
    EXPECT_GT(image.at(7, 5, 0), 0.99f);
    drawing.shapes.clear();
    drawing.shapes.emplace_back(
        Stroke{{{0.0, 5.0}, {30.0, 5.0}, {10.0, 5.0}, {20.0, 5.0}}, Color(0.0f), 2.0});
    image = rasterize(drawing, 1.0);
    EXPECT_LT(image.at(15, 5, 0), 0.01f); // three times over
}

TEST(BarChart, DrawsABarForEachValueThatIsOne) {
    BarChart chart{"speed", {"bunny", "dragon"}, {"ms", false, {}, {}}, {}};
    chart.series.push_back({"ours", seriesColor(1), {3.0, 5.0}});
    chart.series.push_back({"theirs", seriesColor(2), {7.0, std::nan("")}});
    chart.valueFormat = "{:.1f}";
    int bars = 0;
    for (const Shape& shape : drawChart(chart).shapes) {
        const auto* fill = std::get_if<Fill>(&shape);
        bars += fill != nullptr && fill->opacity == 1.0 ? 1 : 0;
    }
    EXPECT_EQ(bars, 3 + 2); // and two in the legend
    EXPECT_THAT(toSvg(drawChart(chart)), HasSubstr(">7.0</text>"));
}

TEST(WritePlot, ByTheExtension) {
    const test::TemporaryFolder folder;
    const Drawing drawing = placeBeside({drawChart(exampleChart()), drawChart(exampleChart())});
    writePlot(folder / "a.svg", drawing);
    EXPECT_THAT(test::readText(folder / "a.svg"), HasSubstr("<svg"));
    writePlot(folder / "a.PNG", drawing);
    const FloatImage image = readImage(folder / "a.PNG").image;
    EXPECT_EQ(image.width, 2 * 2 * 640);
    EXPECT_EQ(image.height, 2 * 480);
    EXPECT_THROW(writePlot(folder / "a.jpg", drawing), UsageError);
}

} // namespace
} // namespace celadon::plot
