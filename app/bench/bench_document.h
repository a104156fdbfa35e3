#pragma once

#include "app/bench/bench_measure.h"
#include "app/plot/drawing.h"
#include "renderer/output/image.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// What a suite hands back, whatever it measures: numbers, a table, charts and pictures.
namespace celadon::app {

using BenchJson = nlohmann::ordered_json;

struct BenchDocument {
    BenchJson json;
    std::string markdown;
    std::vector<std::pair<std::string, plot::Drawing>> charts;  ///< by file name, .svg
    std::vector<std::pair<std::string, FloatImage>> pictures{}; ///< .png, display-encoded R,G,B
};

/// {"suite": ..., "context": ..., "processor": ...}, which every document begins with.
[[nodiscard]] BenchJson documentHead(const std::string& suite, const BenchMachine& machine);

/// A number, null where it is NaN or infinite.
[[nodiscard]] BenchJson number(double value);
/// A cell of a table, "-" where nothing was measured. @param format of fmt, such as "{:.2f} %"
[[nodiscard]] std::string cell(const char* format, double value);

/// Charts and pictures into a folder, which is made. @throws OutputError
void writeFolder(const BenchDocument& document, const std::filesystem::path& folder);

/// The final pictures of several frames in a row, tone mapped before black; below each the heat map
/// of its error in exitance against the first, whose root mean square times `largest` is white.
/// @return display-encoded R,G,B
[[nodiscard]] FloatImage pictureRow(const std::vector<const FloatImage*>& frames, float largest);

} // namespace celadon::app
