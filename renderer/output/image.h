#pragma once

#include <string>
#include <utility>
#include <vector>

/// A floating-point picture with named channels, top row first. No file formats here.
namespace celadon {

struct FloatImage {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels; ///< "R", "G", "B", "A", "exitance.R", ...
    std::vector<float> pixels;         ///< [height][width][channels], finite

    [[nodiscard]] std::size_t channelCount() const { return channels.size(); }
    [[nodiscard]] int channelIndex(const std::string& name) const; ///< -1: absent
    [[nodiscard]] float& at(int x, int y, int channel);
    [[nodiscard]] float at(int x, int y, int channel) const;
};

} // namespace celadon
