#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>

/// Values of options: from text to checked numbers. All messages read alike: they name the option,
/// what was given and what would do. Independent of the locale; no infinities, no NaN.
namespace celadon::app {

/// What stands on the command line for one option.
struct Argument {
    std::string option; ///< "--alpha"
    std::string text;
};

struct NumberRange {
    double least = std::numeric_limits<double>::lowest();
    double most = std::numeric_limits<double>::max();
    bool excludesLeast = false; ///< a value must be above `least`, not at it
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{0.0, std::numeric_limits<double>::max(), true};
inline constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::max(), false};

/// All throw UsageError.
[[nodiscard]] double parseNumber(const Argument& argument, const NumberRange& range = kAnyNumber);
[[nodiscard]] int parseInteger(const Argument& argument, int least, int most);
/// "X,Y,Z"
[[nodiscard]] glm::dvec3 parseVector(const Argument& argument,
                                     const NumberRange& range = kAnyNumber);
/// "WxH", each side 1..maxSide, width * height <= maxPixels
[[nodiscard]] glm::ivec2 parseSize(const Argument& argument, int maxSide, long long maxPixels);
/// Not empty, and not another option that was taken for a value.
[[nodiscard]] std::string parseText(const Argument& argument);
[[nodiscard]] std::filesystem::path parsePath(const Argument& argument);
/// The index of the word among the choices.
[[nodiscard]] std::size_t parseChoice(const Argument& argument,
                                      std::span<const std::string_view> choices);

struct FrameRange {
    int first = 0;
    int last = 0; ///< included
    [[nodiscard]] int count() const { return last - first + 1; }
};
/// "A:B" with 0 <= A <= B, or "A" alone
[[nodiscard]] FrameRange parseFrames(const Argument& argument);

struct LevelCounts {
    int irradiance = 6;
    int splatting = 5;
};
/// "N" for both, or "IRRADIANCE,SPLATTING"
[[nodiscard]] LevelCounts parseLevels(const Argument& argument, int most);

} // namespace celadon::app
