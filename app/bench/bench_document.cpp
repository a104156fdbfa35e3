#include "app/bench/bench_document.h"

#include "app/plot/write_plot.h"
#include "renderer/output/image_compare.h"
#include "renderer/output/image_io.h"
#include "renderer/output/tone_map.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace celadon::app {

namespace {

/// Copies a picture of the same channels to a place in a larger one.
void paste(const FloatImage& part, int left, int top, FloatImage& whole) {
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                whole.at(left + x, top + y, c) = part.at(x, y, c);
            }
        }
    }
}

double rootMeanSquare(const FloatImage& image) {
    double squares = 0.0;
    for (const float value : image.pixels) {
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    return image.pixels.empty() ? 0.0
                                : std::sqrt(squares / static_cast<double>(image.pixels.size()));
}

} // namespace

BenchJson documentHead(const std::string& suite, const BenchMachine& machine) {
    BenchJson json;
    json["suite"] = suite;
    json["context"] = {{"kind", machine.contextKind},
                       {"renderer", machine.renderer},
                       {"version", machine.version}};
    json["processor"] = machine.processor;
    return json;
}

BenchJson number(double value) {
    return std::isfinite(value) ? BenchJson(value) : BenchJson(nullptr);
}

std::string cell(const char* format, double value) {
    return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

void writeFolder(const BenchDocument& document, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw OutputError(folder.string(), error.message(), "name a folder that can be written");
    }
    for (const auto& [name, chart] : document.charts) {
        plot::writePlot(folder / name, chart);
    }
    for (const auto& [name, picture] : document.pictures) {
        writeDisplayImage(folder / name, picture);
    }
}

FloatImage pictureRow(const std::vector<const FloatImage*>& frames, float largest) {
    constexpr int kGap = 4;
    const FloatImage& first = *frames.front();
    const FloatImage truth = extractLayer(first, "exitance");
    const auto white = static_cast<float>(rootMeanSquare(truth)) * largest;
    FloatImage row;
    row.width = (first.width + kGap) * static_cast<int>(frames.size()) - kGap;
    row.height = 2 * first.height + kGap;
    row.channels = {"R", "G", "B"};
    row.pixels.assign(
        static_cast<std::size_t>(row.width) * static_cast<std::size_t>(row.height) * 3, 1.0f);
    DisplaySettings display;
    display.background = glm::vec3(0.0f);
    int left = 0;
    for (const FloatImage* frame : frames) {
        paste(toDisplay(*frame, display), left, 0, row);
        paste(heatMap(errorMap(extractLayer(*frame, "exitance"), truth), white), left,
              first.height + kGap, row);
        left += first.width + kGap;
    }
    return row;
}

} // namespace celadon::app
