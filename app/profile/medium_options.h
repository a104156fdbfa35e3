#pragma once

#include "app/command.h"
#include "subedit/medium.h"

#include <optional>
#include <string>

/// The options by which a command takes a homogeneous medium: a preset, coefficients, or albedo and
/// mean free path (DESIGN 5).
namespace celadon::app {

struct MediumOptions {
    std::string preset;
    std::string absorption;
    std::string reducedScattering;
    std::string scattering;
    std::string albedo;
    std::string surfaceAlbedo;
    std::string meanFreePath;
    std::optional<double> eta;
    double anisotropy = 0.0;

    bool operator==(const MediumOptions&) const = default;
};

inline constexpr double kDefaultEta = 1.3; ///< of the media that Jensen et al. 2001 measured

enum class MediumSource { Preset, Coefficients, Albedo, SurfaceAlbedo };

void addMediumOptions(CLI::App& app, MediumOptions& options);

/// Which of the ways to give a medium is used. @param command for messages: "profile make"
/// @throws UsageError unless it is exactly one, and complete
[[nodiscard]] MediumSource mediumSource(const MediumOptions& options, const std::string& command);

/// The medium, `--albedo` being alpha' of single scattering; `--surface-albedo` is inverted,
/// exactly for a half space.
/// @throws UsageError
[[nodiscard]] subedit::Medium makeMedium(const MediumOptions& options, MediumSource source);

/// Surface albedo and mean free path as given. @throws UsageError
[[nodiscard]] glm::dvec3 givenAlbedo(const MediumOptions& options);
[[nodiscard]] glm::dvec3 givenMeanFreePath(const MediumOptions& options);

} // namespace celadon::app
