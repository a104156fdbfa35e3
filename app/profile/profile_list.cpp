#include "app/option_takers.h"
#include "app/profile/profile_commands.h"
#include "subedit/models/half_space.h"
#include "subedit/presets.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

struct ListOptions {
    std::string word;
    bool json = false;
};

nlohmann::json toJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void printText(const std::vector<MediumPreset>& presets) {
    fmt::print("{:22} {:25} {:27} {:5} {:17} {:22} {}\n", "name", "sigma_s' [1/mm]",
               "sigma_a [1/mm]", "eta", "albedo", "source", "what");
    for (const MediumPreset& preset : presets) {
        const Medium& m = preset.medium;
        const glm::dvec3 albedo = halfSpaceTotal(m);
        fmt::print("{:22} {:25} {:27} {:<5} {:17} {:22} {}\n", preset.name,
                   fmt::format("{} {} {}", m.reducedScattering.x, m.reducedScattering.y,
                               m.reducedScattering.z),
                   fmt::format("{} {} {}", m.absorption.x, m.absorption.y, m.absorption.z), m.eta,
                   fmt::format("{:.3f} {:.3f} {:.3f}", albedo.x, albedo.y, albedo.z), preset.source,
                   preset.description);
    }
}

void printJson(const std::vector<MediumPreset>& presets) {
    nlohmann::json list = nlohmann::json::array();
    for (const MediumPreset& preset : presets) {
        list.push_back({{"name", preset.name},
                        {"description", preset.description},
                        {"source", preset.source},
                        {"reducedScattering", toJson(preset.medium.reducedScattering)},
                        {"absorption", toJson(preset.medium.absorption)},
                        {"eta", preset.medium.eta},
                        {"g", toJson(preset.measuredAnisotropy)},
                        {"albedo", toJson(halfSpaceTotal(preset.medium))}});
    }
    fmt::print("{}\n", list.dump(2));
}

} // namespace

Command addProfileList(CLI::App& profile) {
    const auto options = std::make_shared<ListOptions>();
    CLI::App* list = profile.add_subcommand("list", "Lists the measured media that --preset knows");
    addPositional(*list, "WORD", "Only those with this in their name, description or source",
                  options->word);
    addFlag(*list, "--json", "Result", "Prints a JSON array", options->json);
    return {list, [options] {
                const std::vector<MediumPreset> found = searchMediumPresets(options->word);
                options->json ? printJson(found) : printText(found);
            }};
}

} // namespace celadon::app
