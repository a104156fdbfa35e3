#pragma once

#include "app/bench/bench_run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace celadon::app {

struct BenchReport {
    BenchOptions options;
    std::string contextKind, renderer, version, processor;
    std::vector<SceneResult> scenes;
};

/// One JSON object; what was not measured is null.
[[nodiscard]] std::string toJson(const BenchReport& report);
/// The table as Markdown: frames per second, speed-ups beside the paper's, errors.
[[nodiscard]] std::string toMarkdown(const BenchReport& report);
/// speedup.svg, error_time.svg and stages.svg in a folder, which is made.
void writePlots(const BenchReport& report, const std::filesystem::path& folder);

/// "Intel(R) Xeon(R) Processor, 2 threads", as far as the system tells.
[[nodiscard]] std::string describeProcessor();

} // namespace celadon::app
