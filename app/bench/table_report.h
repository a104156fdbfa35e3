#pragma once

#include "app/bench/bench_document.h"
#include "app/bench/table_suite.h"

#include <vector>

namespace celadon::app {

/// Numbers, the table in Markdown (speeds beside the paper's, errors, shares of the stages as in
/// its Table 2) and charts. What was not measured is null, or "-".
[[nodiscard]] BenchDocument tableDocument(const BenchMachine& machine, const TableOptions& options,
                                          const std::vector<SceneResult>& scenes);

} // namespace celadon::app
