#include "app/profile/profile_output.h"

#include "app/log.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/medium.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace celadon::app {

using namespace subedit;

void emit(const std::string& output, const std::string& text) {
    if (output.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
    } else {
        writeFileAtomically(output, text);
    }
}

bool hasEnding(const std::string& file, std::string_view ending) {
    return file.size() > ending.size() &&
           std::equal(
               ending.begin(), ending.end(), file.end() - std::ssize(ending),
               [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

void checkOutput(const std::string& output, const std::vector<std::string_view>& endings) {
    if (output.empty()) {
        return;
    }
    if (std::ranges::none_of(endings, [&](std::string_view e) { return hasEnding(output, e); })) {
        throw UsageError(fmt::format("-o '{}'", output), "is of no known kind",
                         fmt::format("end it in {}", fmt::join(endings, ", ")));
    }
    checkWritable(output);
}

void checkMaterialOutput(const std::string& command, const std::string& output) {
    if (output.empty()) {
        throw UsageError(command, "-o is missing", "name the .subedit.exr to write");
    }
    checkOutput(output, {".subedit.exr", ".exr"});
}

MaterialMap oneTexel(const FittedProfile& fitted, double eta, const std::string& name) {
    MaterialMap map;
    map.name = name;
    map.width = map.height = 1;
    map.segments = fitted.segments;
    map.maxRadiusMm = fitted.maxRadiusMm;
    map.eta = static_cast<float>(eta);
    map.logProfile = fitted.logProfile;
    return map;
}

void reportLine(const std::string& output, const std::string& line) {
    if (output.empty()) {
        fmt::print("{}\n", line);
    } else {
        log::info("{}", line);
    }
}

void reportFit(const std::string& output, const RadialCurves& curves, const FittedProfile& fitted) {
    const glm::dvec3 albedo = diffuseAlbedo(fitted.view());
    const glm::dvec3 radius = effectiveRadiusMm(fitted.view());
    const FitError error = measureFit(curves, fitted);
    reportLine(output,
               fmt::format("r_s {:.4g} mm, {} segments", fitted.maxRadiusMm, fitted.segments));
    for (int channel = 0; channel < 3; ++channel) {
        reportLine(
            output,
            fmt::format("{:5}: albedo {:.4f} (curve {:.4f}), R_P {:.4g} mm, rms error of ln P "
                        "{:.3g} ({:.2g} outside the first segment), {:.2g} % of the energy "
                        "misplaced",
                        channelName(channel), albedo[channel],
                        curves[static_cast<std::size_t>(channel)].total, radius[channel],
                        error.rmsLog[channel], error.rmsLogOutside[channel],
                        100.0 * error.misplaced[channel]));
    }
}

} // namespace celadon::app
