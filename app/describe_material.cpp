#include "app/describe_material.h"

#include "app/log.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/medium.h"
#include "subedit/radius_map.h"
#include "subedit/texel_energy.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

namespace celadon::app {
namespace {

using namespace subedit;

constexpr float kCutEnergy = 0.01f;
constexpr int kFewSegments = 8; ///< with fewer, the last one holds much in any case

/// Least and greatest of per-texel values, by channel or alone.
struct Extent {
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();

    void add(float value) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
    }
};

struct MaterialSummary {
    Extent albedo[3];
    Extent radius;
    float cut = 0.0f; ///< largest part of a texel's energy within the last segment
    double memoryMb = 0.0;
};

MaterialSummary summarize(const MaterialMap& map) {
    MaterialSummary summary;
    const std::vector<float> albedo = albedoMap(map);
    for (std::size_t i = 0; i < albedo.size(); ++i) {
        summary.albedo[i % 3].add(albedo[i]);
    }
    if (map.segments >= kFewSegments) {
        const std::vector<float> last = lastSegmentMap(map);
        summary.cut = *std::max_element(last.begin(), last.end());
    }
    for (const float radius : effectiveRadiusMap(map)) {
        summary.radius.add(radius);
    }
    summary.memoryMb = static_cast<double>(map.logProfile.size() * sizeof(float)) / 1e6;
    return summary;
}

void printSummary(const MaterialMap& map, const MaterialSummary& summary) {
    fmt::print("name      {}\n", map.name);
    fmt::print("size      {} x {} texels{}\n", map.width, map.height,
               map.isHomogeneous() ? " (homogeneous)" : "");
    fmt::print("segments  {} to r_s = {:.4g} mm\n", map.segments, map.maxRadiusMm);
    fmt::print("eta       {:.4g}\n", map.eta);
    for (int channel = 0; channel < 3; ++channel) {
        fmt::print("albedo    {:5} {:.4f} to {:.4f}\n", channelName(channel),
                   summary.albedo[channel].least, summary.albedo[channel].greatest);
    }
    fmt::print("R_P       {:.4g} to {:.4g} mm (energy 0.95, largest channel)\n",
               summary.radius.least, summary.radius.greatest);
    fmt::print("channels  {}{}\n", map.roughness.empty() ? "no roughness" : "roughness",
               map.specular.empty() ? ", no specular" : ", specular");
    fmt::print("memory    {:.4g} MB\n", summary.memoryMb);
}

/// What a user should know of a material that can be used as it is.
void findWarnings(const MaterialMap& map, const MaterialSummary& summary,
                  std::vector<std::string>& warnings) {
    const float segment = map.maxRadiusMm / static_cast<float>(map.segments);
    if (summary.radius.least < segment) {
        warnings.push_back(
            fmt::format("the shortest profile, R_P = {:.3g} mm, ends within the first "
                        "segment of {:.3g} mm: more segments, or a smaller r_s, "
                        "would hold its shape",
                        summary.radius.least, segment));
    }
    if (summary.cut > kCutEnergy) {
        warnings.push_back(fmt::format("up to {:.2g} % of a profile's energy lies within the last "
                                       "segment: it may have been cut at r_s",
                                       100.0f * summary.cut));
    }
    if (std::max({summary.albedo[0].greatest, summary.albedo[1].greatest,
                  summary.albedo[2].greatest}) < kBlackAlbedo) {
        warnings.emplace_back("it is black: no profile returns light");
    }
}

nlohmann::json summaryJson(const MaterialMap& map, const MaterialSummary& summary,
                           const std::vector<std::string>& warnings) {
    nlohmann::json albedoMin = nlohmann::json::array();
    nlohmann::json albedoMax = nlohmann::json::array();
    for (const Extent& extent : summary.albedo) {
        albedoMin.push_back(extent.least);
        albedoMax.push_back(extent.greatest);
    }
    return {{"name", map.name},
            {"size", {map.width, map.height}},
            {"segments", map.segments},
            {"maxRadius", map.maxRadiusMm},
            {"eta", map.eta},
            {"albedo", {{"min", albedoMin}, {"max", albedoMax}}},
            {"effectiveRadius", {{"min", summary.radius.least}, {"max", summary.radius.greatest}}},
            {"roughness", !map.roughness.empty()},
            {"specular", !map.specular.empty()},
            {"memoryMegabytes", summary.memoryMb},
            {"warnings", warnings}};
}

} // namespace

void describeMaterial(const std::string& nameOrPath, bool asJson) {
    std::vector<std::string> warnings;
    const std::filesystem::path file = findMaterial(nameOrPath);
    const MaterialMap map = readMaterial(file, &warnings);
    const MaterialSummary summary = summarize(map);
    findWarnings(map, summary, warnings);
    if (asJson) {
        // A name that is not UTF-8 is shown with replacement characters rather than refused.
        fmt::print("{}\n", summaryJson(map, summary, warnings)
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        printSummary(map, summary);
    }
    for (const std::string& warning : warnings) {
        log::warning("'{}': {}", file.string(), warning);
    }
}

} // namespace celadon::app
