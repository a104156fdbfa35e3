#include "renderer/gather/level_accumulation.h"

#include "renderer/gather/four.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

/// What all pixels of one step share.
struct Step {
    const FarEnergies::Selection& energies;
    const AccumulationSettings& settings;
    std::size_t level;       ///< the coarser one
    const ViewLevel& coarse; ///< of it

    /// Of a pixel of the coarser level, mm.
    [[nodiscard]] float widthAt(float depth) const {
        return (depth * settings.pixelScale + settings.pixelOffset) *
               static_cast<float>(1 << level);
    }
    /// See far_ring.glsl.
    [[nodiscard]] static float smoothness(float R_P, float width) {
        return glm::smoothstep(2.5f, 5.0f, R_P / width);
    }
    /// Of a material and others: -ln of their similarity.
    [[nodiscard]] Four difference(float R_P, Four others) const {
        const Four largest = larger(four(std::max(settings.objectRadius, R_P)), others);
        return 8.0f * magnitude(R_P - others) / largest;
    }
    [[nodiscard]] Four positionOf(std::size_t index) const {
        return index == ViewLevel::kNowhere ? Four{} : loadFour(&coarse.positions[4 * index]);
    }
};

/// B over the energy beyond the ring's start, and R_P.
void findLight(const Step& step, int row, std::vector<float>& light) {
    const ViewLevel& level = step.coarse;
    const auto width = static_cast<std::size_t>(level.part.z);
    const std::size_t first = static_cast<std::size_t>(row) * width;
    for (std::size_t i = first; i < first + width; ++i) {
        const float* const s = &level.surfaces[4 * i];
        if (s[2] < 0.0f) {
            continue;
        }
        const auto material = static_cast<int>(s[2]);
        const glm::vec2 uv(s[0], s[1]);
        const Four energy = larger(step.energies.at(step.level, material, uv),
                                   step.energies.at(0, material, uv) - 9.0f);
        Four value = loadFour(&level.exitance[4 * i]) * exponential(-energy);
        value[3] = s[3];
        storeFour(&light[4 * i], value);
    }
}

/// Second differences along both axes; 0 where the surface is not smooth, or its material changes.
class Sharpening {
public:
    Sharpening(const Step& step, const std::vector<float>& light) : mStep(step), mLight(light) {}

    void sharpen(int row, std::vector<float>& sharpened) const {
        const ViewLevel& level = mStep.coarse;
        for (int column = 0; column < level.part.z; ++column) {
            const glm::ivec2 pixel = glm::ivec2(level.part) + glm::ivec2(column, row);
            const std::size_t i = level.indexOf(pixel);
            const float depth = level.positions[4 * i + 3];
            if (depth <= 0.0f) {
                continue;
            }
            Four light = loadFour(&mLight[4 * i]);
            const float smooth = Step::smoothness(light[3], mStep.widthAt(depth));
            if (smooth > 0.0f) {
                const float R_P = light[3];
                light -= 3.0f / 32.0f * smooth * (bend(pixel, {1, 0}, i) + bend(pixel, {0, 1}, i));
                light[3] = R_P;
            }
            storeFour(&sharpened[4 * i], light);
        }
    }

private:
    [[nodiscard]] Four bend(glm::ivec2 pixel, glm::ivec2 axis, std::size_t i) const {
        const ViewLevel& level = mStep.coarse;
        const std::size_t before = level.indexOf(pixel - axis);
        const std::size_t after = level.indexOf(pixel + axis);
        const Four from = mStep.positionOf(before);
        const Four to = mStep.positionOf(after);
        const Four turn = from + to - 2.0f * loadFour(&level.positions[4 * i]);
        const Four chord = to - from;
        if (from[3] <= 0.0f || to[3] <= 0.0f || dot3(turn, turn) > 0.25f * dot3(chord, chord)) {
            return Four{};
        }
        const Four here = loadFour(&mLight[4 * i]);
        const Four a = loadFour(&mLight[4 * before]);
        const Four b = loadFour(&mLight[4 * after]);
        const Four differences = mStep.difference(here[3], Four{a[3], b[3], here[3], here[3]});
        const float largest = std::max(differences[0], differences[1]);
        const float alike = largest > 0.0f ? std::exp(-largest) : 1.0f;
        return alike * (a + b - 2.0f * here);
    }

    const Step& mStep;
    const std::vector<float>& mLight;
};

/// Adds a level's light to the next finer one.
class Upsampling {
public:
    Upsampling(const Step& step, const std::vector<float>& light, ViewLevel& fine)
        : mStep(step), mLight(light), mFine(fine) {}

    void addTo(int row) const {
        for (int column = 0; column < mFine.part.z; ++column) {
            const glm::ivec2 pixel = glm::ivec2(mFine.part) + glm::ivec2(column, row);
            const std::size_t i = mFine.indexOf(pixel);
            if (mFine.scatters(i)) {
                add(pixel, i);
            }
        }
    }

private:
    struct Point {
        Four position, normal;
        float R_P;
        float width; ///< of a pixel of the coarser level, mm
    };
    /// The four coarser pixels about one, and their weights.
    struct Corners {
        std::array<std::size_t, 4> index;
        Four weights;
    };

    void add(glm::ivec2 pixel, std::size_t i) const {
        const float* const s = &mFine.surfaces[4 * i];
        const Four position = loadFour(&mFine.positions[4 * i]);
        const Point o{position, loadFour(&mFine.normals[4 * i]), s[3], mStep.widthAt(position[3])};
        const Corners corners = cornersOf(pixel);
        const float rough = roughness(o, corners);
        Four light = rough < 1.0f ? interpolate(o, corners) : Four{};
        if (rough > 0.0f) {
            light += rough * (fit(o, pixel / 2) - light);
        }
        const Four energy = exponential(
            mStep.energies.at(mStep.level, static_cast<int>(s[2]), glm::vec2(s[0], s[1])));
        const Four before = loadFour(&mFine.exitance[4 * i]);
        Four sum = before + energy * light;
        if (mStep.level == 1) {
            sum = larger(sum, Four{});
        }
        sum[3] = before[3];
        storeFour(&mFine.exitance[4 * i], sum);
    }

    [[nodiscard]] Corners cornersOf(glm::ivec2 pixel) const {
        const glm::ivec2 base = (pixel + 1) / 2 - 1;
        const std::size_t first = mStep.coarse.indexOf(base);
        const std::size_t last = mStep.coarse.indexOf(base + 1);
        Corners corners{};
        if (first != ViewLevel::kNowhere && last != ViewLevel::kNowhere) {
            corners.index = {first, first + 1, last - 1, last};
        } else {
            corners.index = {first, mStep.coarse.indexOf(base + glm::ivec2(1, 0)),
                             mStep.coarse.indexOf(base + glm::ivec2(0, 1)), last};
        }
        const float right = (pixel.x & 1) == 0 ? 0.75f : 0.25f;
        const float upper = (pixel.y & 1) == 0 ? 0.75f : 0.25f;
        corners.weights = Four{1.0f - right, right, 1.0f - right, right} *
                          Four{1.0f - upper, 1.0f - upper, upper, upper};
        return corners;
    }

    /// 0 where the point lies between the four about it. 1: there is no interpolating.
    [[nodiscard]] float roughness(const Point& o, const Corners& corners) const {
        Four between{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Four position = mStep.positionOf(corners.index[i]);
            if (position[3] <= 0.0f) {
                return 1.0f;
            }
            between += corners.weights[i] * position;
        }
        constexpr float kSmooth = 0.1f;
        const Four off = between - o.position;
        const float squared = dot3(off, off);
        if (squared <= kSmooth * kSmooth * o.width * o.width) {
            return 0.0f;
        }
        return glm::smoothstep(kSmooth, 0.3f, std::sqrt(squared) / o.width);
    }

    [[nodiscard]] Four interpolate(const Point& o, const Corners& corners) const {
        std::array<Four, 4> lights;
        Four radii{};
        for (std::size_t i = 0; i < 4; ++i) {
            lights[i] = loadFour(&mLight[4 * corners.index[i]]);
            radii[i] = lights[i][3];
        }
        const Four weights = corners.weights * exponential(-mStep.difference(o.R_P, radii));
        Four sum{};
        for (std::size_t i = 0; i < 4; ++i) {
            sum += weights[i] * lights[i];
        }
        return sum / (weights[0] + weights[1] + weights[2] + weights[3]);
    }

    /// Weighted least squares, see accumulation_rough.comp.
    [[nodiscard]] Four fit(const Point& o, glm::ivec2 center) const {
        constexpr float kLeastVariance = 0.05f;
        constexpr float kFarthest = 1.5f;
        Neighborhood about;
        gather(o, center, about);
        float total = 1e-30f;
        Four place{}, light{};
        std::array<Four, 3> places{}, lights{}; // a column for each part of the offset
        for (std::size_t i = 0; i < about.count; ++i) {
            const float w = about.weights[i];
            const Four offset = about.offsets[i];
            const Four weighed = w * about.lights[i];
            total += w;
            place += w * offset;
            light += weighed;
            for (std::size_t c = 0; c < 3; ++c) {
                places[c] += w * offset[c] * offset;
                lights[c] += offset[c] * weighed;
            }
        }
        place /= total;
        light /= total;
        const float away = std::sqrt(dot3(place, place));
        const Four along = away > 1e-6f ? -place / away : Four{};
        const Four spread = along[0] * places[0] + along[1] * places[1] + along[2] * places[2];
        const float variance = std::max(dot3(along, spread) / total - away * away, 0.0f);
        const Four change = along[0] * lights[0] + along[1] * lights[1] + along[2] * lights[2];
        const Four slope = (change / total + light * away) / (variance + kLeastVariance);
        return light + Step::smoothness(o.R_P, o.width) * std::min(away, kFarthest) * slope;
    }

    static constexpr int kSide = 5; ///< pixels of the coarser level that a fit looks at
    struct Neighborhood {
        static constexpr std::size_t kRoom = (kSide * kSide + 3) / 4 * 4;
        std::size_t count = 0;
        std::array<Four, kRoom> offsets, lights;
        alignas(16) std::array<float, kRoom> weights{};
    };

    void gather(const Point& o, glm::ivec2 center, Neighborhood& about) const {
        alignas(16) std::array<float, Neighborhood::kRoom> facings{}, exponents{};
        for (int i = 0; i < kSide * kSide; ++i) {
            const std::size_t index =
                mStep.coarse.indexOf(center + glm::ivec2(i % kSide, i / kSide) - kSide / 2);
            const Four position = mStep.positionOf(index);
            if (position[3] <= 0.0f) {
                continue;
            }
            const Four light = loadFour(&mLight[4 * index]);
            const Four normal = loadFour(&mStep.coarse.normals[4 * index]);
            const Four offset = (position - o.position) / o.width;
            const float plane =
                std::max(std::abs(dot3(o.normal, offset)), std::abs(dot3(normal, offset)));
            const float facing = std::max(dot3(o.normal, normal), 0.0f);
            const float difference = mStep.difference(o.R_P, four(light[3]))[0];
            const std::size_t to = about.count++;
            about.offsets[to] = offset;
            about.lights[to] = light;
            facings[to] = facing * facing + 0.001f;
            exponents[to] = -0.2f * dot3(offset, offset) - plane - difference;
        }
        for (std::size_t i = 0; i < about.count; i += 4) {
            storeFour(&about.weights[i],
                      exponential(loadFour(&exponents[i])) * loadFour(&facings[i]) + 1e-12f);
        }
    }

    const Step& mStep;
    const std::vector<float>& mLight;
    ViewLevel& mFine;
};

} // namespace

void LevelAccumulation::accumulate(std::span<ViewLevel> levels,
                                   const FarEnergies::Selection& energies,
                                   const AccumulationSettings& settings) {
    for (std::size_t k = levels.size() - 1; k > 0; --k) {
        const ViewLevel& coarse = levels[k];
        const Step step{energies, settings, k, coarse};
        mLight.resize(coarse.positions.size());
        forEachRow(coarse, [&](int row) { findLight(step, row, mLight); });
        if (settings.sharpens) {
            mSharpened.resize(mLight.size());
            const Sharpening sharpening(step, mLight);
            forEachRow(coarse, [&](int row) { sharpening.sharpen(row, mSharpened); });
        }
        const Upsampling upsampling(step, settings.sharpens ? mSharpened : mLight, levels[k - 1]);
        forEachRow(levels[k - 1], [&](int row) { upsampling.addTo(row); });
    }
}

} // namespace celadon
