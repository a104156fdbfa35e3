#include "app/command_compare.h"

#include "app/comparison.h"
#include "app/log.h"
#include "app/overwriting.h"
#include "renderer/output/image_io.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace celadon::app {
namespace {

/// A condition under which a script wants to hear "failed".
struct Limit {
    Metric metric;
    double value;
    bool above; ///< fails above the value, else below it
};

struct CompareOptions {
    std::string a, b;
    std::vector<Metric> metrics; ///< empty: the usual ones
    bool all = false;            ///< every metric that the pictures allow, besides `metrics`
    std::vector<Limit> limits;
    std::optional<std::filesystem::path> heatMap;
    std::optional<std::filesystem::path> output;
    bool json = false;
    ComparisonSettings settings;
};

void takeMetrics(CompareOptions& options, const Argument& argument) {
    std::size_t begin = 0;
    while (begin <= argument.text.size()) {
        const std::size_t end = std::min(argument.text.find(',', begin), argument.text.size());
        const std::string word = argument.text.substr(begin, end - begin);
        if (word == "all") {
            options.all = true;
        } else {
            options.metrics.push_back(parseMetric(word));
        }
        begin = end + 1;
    }
}

void takeLimit(CompareOptions& options, const Argument& argument, bool above) {
    const std::size_t equals = argument.text.find('=');
    if (equals == std::string::npos) {
        throw UsageError(fmt::format("{} '{}'", argument.option, argument.text),
                         "is no METRIC=VALUE", "write, for example, rmse=0.01");
    }
    options.limits.push_back({parseMetric(argument.text.substr(0, equals)),
                              parseNumber({argument.option, argument.text.substr(equals + 1)}),
                              above});
}

struct Result {
    Metric metric;
    double value;
};

/// A relative error against nothing is no number. The PSNR of equal pictures is infinite, and means
/// it.
bool isUndefined(const Result& result) {
    return !std::isfinite(result.value) && result.metric != Metric::Psnr;
}

/// Undefined metrics are refused where they were asked for, and said where they were not.
void explainUndefined(const std::vector<Result>& results, const CompareOptions& options) {
    for (const Result& result : results) {
        if (!isUndefined(result)) {
            continue;
        }
        const auto isMetric = [&result](const auto& asked) { return asked == result.metric; };
        if (std::ranges::any_of(options.metrics, isMetric) ||
            std::ranges::any_of(options.limits, isMetric, &Limit::metric)) {
            throw InputError(fmt::format("'{}' against '{}'", options.a, options.b),
                             fmt::format("{} is undefined: the reference is all zero",
                                         metricName(result.metric)),
                             "choose another metric, such as rmse");
        }
        log::warning("{} is undefined, since '{}' is all zero", metricName(result.metric),
                     options.b);
    }
}

std::vector<Result> computeResults(Comparison& comparison, const CompareOptions& options) {
    std::vector<Metric> wanted;
    if (options.all) {
        wanted.assign(allMetrics().begin(), allMetrics().end());
    } else if (options.metrics.empty()) {
        wanted = usualMetrics();
    }
    std::erase_if(wanted, [&](Metric metric) { return !comparison.has(metric); });
    wanted.insert(wanted.end(), options.metrics.begin(), options.metrics.end());
    for (const Limit& limit : options.limits) {
        wanted.push_back(limit.metric);
    }
    std::vector<Result> results;
    for (const Metric metric : wanted) {
        const bool known = std::any_of(results.begin(), results.end(),
                                       [&](const Result& r) { return r.metric == metric; });
        if (!known) {
            results.push_back({metric, comparison.value(metric)});
        }
    }
    return results;
}

std::string toJsonText(const CompareOptions& options, const Comparison& comparison,
                       const std::vector<Result>& results) {
    nlohmann::ordered_json json;
    json["a"] = options.a;
    json["b"] = options.b;
    json["size"] = {comparison.width(), comparison.height()};
    json["layer"] = options.settings.layer.empty() ? "color" : options.settings.layer;
    json["values"] = comparison.displayEncoded() ? "display" : "linear";
    for (const Result& result : results) {
        // JSON has no infinity: the PSNR of equal pictures is null, and so is what is undefined.
        json[metricName(result.metric)] = std::isfinite(result.value)
                                              ? nlohmann::ordered_json(result.value)
                                              : nlohmann::ordered_json(nullptr);
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string toPlainText(const std::vector<Result>& results) {
    std::string text;
    for (const Result& result : results) {
        text += fmt::format("{:<13} {:.6g}\n", metricName(result.metric), result.value);
    }
    return text;
}

void checkLimits(const CompareOptions& options, const std::vector<Result>& results) {
    for (const Limit& limit : options.limits) {
        const double value = std::find_if(results.begin(), results.end(), [&](const Result& r) {
                                 return r.metric == limit.metric;
                             })->value;
        if (limit.above ? !(value <= limit.value) : !(value >= limit.value)) {
            throw Error(fmt::format("'{}' against '{}'", options.a, options.b),
                        fmt::format("{} is {:.6g}, {} the limit {:g}", metricName(limit.metric),
                                    value, limit.above ? "above" : "below", limit.value),
                        "", ExitCode::Failed);
        }
    }
}

void checkCompareOptions(const CompareOptions& options) {
    if (options.a.empty() || options.b.empty()) {
        throw UsageError("compare", "two pictures are needed",
                         "write celadon compare A B, B being the reference");
    }
    std::vector<NamedFile> outputs;
    if (options.heatMap) {
        if (imageFormat(*options.heatMap) == ImageFormat::Exr) {
            throw UsageError("--heatmap", "is a picture to look at", "choose .png, .jpg or .tif");
        }
        checkWritable(*options.heatMap);
        outputs.push_back({"--heatmap", *options.heatMap});
    }
    if (options.output) {
        checkWritable(*options.output);
        outputs.push_back({"--output", *options.output});
    }
    refuseOverwriting(outputs, {{"A", options.a}, {"B", options.b}});
}

void compare(const CompareOptions& options) {
    checkCompareOptions(options);
    Comparison comparison(options.a, options.b, options.settings);
    for (const std::string& warning : comparison.warnings()) {
        log::warning("{}", warning);
    }
    const std::vector<Result> results = computeResults(comparison, options);
    explainUndefined(results, options);
    if (options.heatMap) {
        writeDisplayImage(*options.heatMap, comparison.heatMap());
    }
    const std::string text =
        options.json ? toJsonText(options, comparison, results) : toPlainText(results);
    if (options.output) {
        writeFileAtomically(*options.output, std::string_view(text));
    } else {
        std::fputs(text.c_str(), stdout);
    }
    checkLimits(options, results);
}

} // namespace

Command addCompareCommand(CLI::App& root) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = root.add_subcommand("compare", "Measures how much two pictures differ");
    CompareOptions& o = *options;
    addPositional(*command, "A", "The picture to be judged", o.a);
    addPositional(*command, "B", "The reference", o.b);
    const char* what = "What to compare";
    addOption(*command, "--layer",
              {what, "NAME", "A layer of EXR files, such as exitance; default: the color"},
              [&o](const Argument& a) { o.settings.layer = parseText(a); });
    addRepeatable(*command, "--metric",
                  {what, "NAME[,NAME...]",
                   metricWords() + " or all; default: all but flip-hdr, which is slow"},
                  [&o](const Argument& a) { takeMetrics(o, a); });
    addOption(*command, "--exposure",
              {what, "EV", "Shows linear pictures to ssim and flip at 2^EV; default 0"},
              [&o](const Argument& a) {
                  o.settings.exposureEv = parseNumber(a, {-100.0, 100.0, false});
              });
    addOption(*command, "--tonemap",
              {what, "neutral|aces|none",
               "Shows linear pictures to ssim and flip through this curve; default neutral"},
              [&o](const Argument& a) { o.settings.toneMap = parseToneMap(a.text); });
    const char* results = "Results";
    addFlag(*command, "--json", results,
            "One JSON object, a number per metric; null where it is infinite", o.json);
    addOption(*command, "-o,--output", {results, "FILE", "Numbers into a file, not to stdout"},
              [&o](const Argument& a) { o.output = parsePath(a); });
    addOption(*command, "--heatmap",
              {results, "FILE", "A picture of where they differ (flip; else absolute error)"},
              [&o](const Argument& a) { o.heatMap = parsePath(a); });
    addRepeatable(*command, "--fail-above",
                  {results, "METRIC=VALUE", "Exit code 1 when the metric is above the value"},
                  [&o](const Argument& a) { takeLimit(o, a, true); });
    addRepeatable(*command, "--fail-below",
                  {results, "METRIC=VALUE", "Exit code 1 when the metric is below the value"},
                  [&o](const Argument& a) { takeLimit(o, a, false); });
    return {command, [options] { compare(*options); }};
}

} // namespace celadon::app
