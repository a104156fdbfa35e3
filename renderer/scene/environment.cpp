#include "renderer/scene/environment.h"

#include "subedit/assert.h"

#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>

namespace celadon {

namespace {

/// A rectangle of texels, half open.
struct Region {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    double power = 0.0;
};

struct LessPower {
    bool operator()(const Region& a, const Region& b) const { return a.power < b.power; }
};

/// A map with the geometry of its rows.
class Panorama {
public:
    explicit Panorama(const EnvironmentMap& map)
        : mMap(map), mSolidAngle(static_cast<std::size_t>(map.height)) {
        // Exact, 2 pi / width times the difference of the cosines at a row's borders: the texels'
        // sum is 4 pi for every size.
        for (int y = 0; y < map.height; ++y) {
            const double top = std::cos(glm::pi<double>() * y / map.height);
            const double bottom = std::cos(glm::pi<double>() * (y + 1) / map.height);
            mSolidAngle[static_cast<std::size_t>(y)] =
                glm::two_pi<double>() / map.width * (top - bottom);
        }
    }

    [[nodiscard]] double solidAngle(int y) const {
        return mSolidAngle[static_cast<std::size_t>(y)];
    }

    [[nodiscard]] const glm::vec3& radiance(int x, int y) const {
        return mMap.radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(mMap.width) +
                             static_cast<std::size_t>(x)];
    }

    /// Luminance (Rec. 709) times solid angle; a texel with any light has some, because the
    /// weights are positive.
    [[nodiscard]] double power(int x, int y) const {
        const glm::vec3& c = radiance(x, y);
        return (0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) +
                0.0722 * static_cast<double>(c.z)) *
               solidAngle(y);
    }

    [[nodiscard]] glm::dvec3 direction(int x, int y) const {
        const double theta = glm::pi<double>() * (y + 0.5) / mMap.height;
        const double phi = glm::two_pi<double>() * ((x + 0.5) / mMap.width - 0.5);
        return {std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)};
    }

    [[nodiscard]] int width() const { return mMap.width; }
    [[nodiscard]] int height() const { return mMap.height; }

private:
    const EnvironmentMap& mMap;
    std::vector<double> mSolidAngle;
};

/// Cuts marginal powers into two parts as equal as possible, both lit.
/// @return the first index of the second part, or 0 when all the power is in one place
std::size_t medianCut(const std::vector<double>& marginal, double total) {
    std::size_t best = 0;
    double bestDifference = 0.0;
    double left = 0.0;
    double right = total;
    std::size_t lastLit = marginal.size();
    while (lastLit > 0 && marginal[lastLit - 1] <= 0.0) {
        --lastLit;
    }
    for (std::size_t i = 1; i < lastLit; ++i) {
        left += marginal[i - 1];
        right -= marginal[i - 1];
        const double difference = std::abs(left - right);
        if (left > 0.0 && (best == 0 || difference < bestDifference)) {
            best = i;
            bestDifference = difference;
        }
    }
    return best;
}

/// @return false when all the power of a region is in one texel
bool split(const Panorama& panorama, const Region& region, Region& first, Region& second) {
    std::vector<double> columns(static_cast<std::size_t>(region.x1 - region.x0));
    std::vector<double> rows(static_cast<std::size_t>(region.y1 - region.y0));
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            const double power = panorama.power(x, y);
            columns[static_cast<std::size_t>(x - region.x0)] += power;
            rows[static_cast<std::size_t>(y - region.y0)] += power;
        }
    }
    // The longer side on the sphere: a row is shorter by the sine of its inclination (Debevec 2005,
    // "A median cut algorithm for light probe sampling", section 2).
    const double middle = 0.5 * (region.y0 + region.y1) / panorama.height();
    const double wide = 2.0 * static_cast<double>(columns.size()) / panorama.width() *
                        std::sin(glm::pi<double>() * middle);
    const double high = static_cast<double>(rows.size()) / panorama.height();
    std::size_t column = medianCut(columns, region.power);
    std::size_t row = medianCut(rows, region.power);
    if (column == 0 && row == 0) {
        return false;
    }
    const bool cutColumns = row == 0 || (column != 0 && wide >= high);
    first = region;
    second = region;
    first.power = 0.0;
    if (cutColumns) {
        first.x1 = second.x0 = region.x0 + static_cast<int>(column);
        for (std::size_t i = 0; i < column; ++i) {
            first.power += columns[i];
        }
    } else {
        first.y1 = second.y0 = region.y0 + static_cast<int>(row);
        for (std::size_t i = 0; i < row; ++i) {
            first.power += rows[i];
        }
    }
    second.power = std::max(region.power - first.power, 0.0);
    return true;
}

Light lightOf(const Panorama& panorama, const Region& region) {
    Light light;
    light.kind = Light::Kind::Directional;
    light.color = glm::dvec3(0.0);
    glm::dvec3 mean(0.0);
    glm::dvec3 brightest(0.0, 1.0, 0.0);
    double greatestPower = 0.0;
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            const double power = panorama.power(x, y);
            if (power <= 0.0) {
                continue;
            }
            const glm::dvec3 direction = panorama.direction(x, y);
            light.color += glm::dvec3(panorama.radiance(x, y)) * panorama.solidAngle(y);
            mean += power * direction;
            if (power > greatestPower) {
                greatestPower = power;
                brightest = direction;
            }
        }
    }
    // A region around the whole sphere may have no mean direction: then its brightest texel's.
    const double length = glm::length(mean);
    light.direction = length > 1e-6 * region.power ? -mean / length : -brightest;
    return light;
}

} // namespace

glm::vec3 environmentRadiance(const EnvironmentMap& map, glm::dvec3 direction) {
    CELADON_ASSERT(map.width > 0 && map.height > 0);
    const double theta = std::acos(std::clamp(direction.y, -1.0, 1.0));
    const double phi = std::atan2(direction.x, -direction.z);
    const double x = (phi / glm::two_pi<double>() + 0.5) * map.width - 0.5;
    const double y = theta / glm::pi<double>() * map.height - 0.5;
    const double floorX = std::floor(x);
    const double floorY = std::floor(y);
    const auto fractionX = static_cast<float>(x - floorX);
    const auto fractionY = static_cast<float>(y - floorY);

    // Over a pole lies the same row half a turn on, so that the pole itself is continuous.
    const auto texel = [&](int column, int row) {
        if (row < 0 || row >= map.height) {
            column += map.width / 2;
            row = row < 0 ? 0 : map.height - 1;
        }
        column = ((column % map.width) + map.width) % map.width;
        return map.radiance[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(column)];
    };
    const int x0 = static_cast<int>(floorX);
    const int y0 = static_cast<int>(floorY);
    const glm::vec3 top = glm::mix(texel(x0, y0), texel(x0 + 1, y0), fractionX);
    const glm::vec3 bottom = glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fractionX);
    return glm::mix(top, bottom, fractionY);
}

std::vector<Light> environmentLights(const EnvironmentMap& map, int count) {
    const Panorama panorama(map);
    Region sphere{0, map.width, 0, map.height, 0.0};
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            sphere.power += panorama.power(x, y);
        }
    }
    std::vector<Light> lights;
    if (sphere.power <= 0.0 || count < 1) {
        return lights;
    }
    // Always the region of greatest power is cut next, whatever `count` is: for powers of two over
    // a smooth map this is Debevec's recursion; a sun in one texel leaves its share to the others.
    std::priority_queue<Region, std::vector<Region>, LessPower> regions;
    std::vector<Region> finished;
    regions.push(sphere);
    while (!regions.empty() && regions.size() + finished.size() < static_cast<std::size_t>(count)) {
        const Region region = regions.top();
        regions.pop();
        Region first;
        Region second;
        if (split(panorama, region, first, second)) {
            regions.push(first);
            regions.push(second);
        } else {
            finished.push_back(region);
        }
    }
    for (; !regions.empty(); regions.pop()) {
        finished.push_back(regions.top());
    }
    lights.reserve(finished.size());
    for (const Region& region : finished) {
        lights.push_back(lightOf(panorama, region));
    }
    return lights;
}

glm::dvec3 turnedBack(const glm::dvec3& direction, double turnRadians) {
    const double c = std::cos(turnRadians);
    const double s = std::sin(turnRadians);
    return {direction.x * c - direction.z * s, direction.y, direction.z * c + direction.x * s};
}

std::vector<Light> environmentLights(const Environment& environment) {
    if (!environment) {
        return {};
    }
    std::vector<Light> lights = environmentLights(*environment.map, environment.lights);
    for (Light& light : lights) {
        light.direction = turnedBack(light.direction, -environment.turnRadians);
        light.color *= environment.strength;
    }
    return lights;
}

EnvironmentMap halved(const EnvironmentMap& map) {
    const Panorama panorama(map);
    EnvironmentMap half;
    half.width = (map.width + 1) / 2;
    half.height = (map.height + 1) / 2;
    half.radiance.reserve(static_cast<std::size_t>(half.width) *
                          static_cast<std::size_t>(half.height));
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            glm::dvec3 sum(0.0);
            double weight = 0.0;
            for (int v = 2 * y; v < std::min(2 * y + 2, map.height); ++v) {
                for (int u = 2 * x; u < std::min(2 * x + 2, map.width); ++u) {
                    sum += glm::dvec3(panorama.radiance(u, v)) * panorama.solidAngle(v);
                    weight += panorama.solidAngle(v);
                }
            }
            half.radiance.emplace_back(sum / weight);
        }
    }
    return half;
}

} // namespace celadon
