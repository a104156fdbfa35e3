#pragma once

#include "subedit/map/material_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

/// Materials and folders that several tests of subedit/ use.
namespace celadon::subedit::test {

/// ln P = ln(scale) - r / lengthMm, lengths per channel: exactly linear, so that closed forms hold.
inline MaterialMap exponentialMaterial(int segments, float maxRadiusMm, glm::vec3 lengthMm,
                                       float scale = 0.01f) {
    MaterialMap map;
    map.name = "exponential";
    map.width = map.height = 1;
    map.segments = segments;
    map.maxRadiusMm = maxRadiusMm;
    for (int k = 0; k <= segments; ++k) {
        const float r = maxRadiusMm * static_cast<float>(k) / static_cast<float>(segments);
        for (int channel = 0; channel < 3; ++channel) {
            map.logProfile.push_back(
                std::max(std::log(scale) - r / lengthMm[channel], kLogProfileFloor));
        }
    }
    return map;
}

/// A map of exponentials whose lengths vary smoothly by a factor of four.
inline MaterialMap varyingMaterial(int width, int height, int segments) {
    MaterialMap map;
    map.name = "varying";
    map.width = width;
    map.height = height;
    map.segments = segments;
    map.maxRadiusMm = 20.0f;
    map.eta = 1.4f;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float wave =
                std::sin(0.7f * static_cast<float>(x)) * std::cos(0.5f * static_cast<float>(y));
            const float length = 2.0f * std::exp2(wave);
            const MaterialMap texel = exponentialMaterial(
                segments, 20.0f, {length, 0.8f * length, 0.5f * length}, 0.1f / (length * length));
            map.logProfile.insert(map.logProfile.end(), texel.logProfile.begin(),
                                  texel.logProfile.end());
        }
    }
    return map;
}

/// A folder of this process that is removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder()
        : mPath(std::filesystem::temp_directory_path() /
                ("celadon-subedit-test-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(mPath);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return mPath / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return mPath; }

private:
    std::filesystem::path mPath;
};

} // namespace celadon::subedit::test
