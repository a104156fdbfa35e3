#include "subedit/recipes/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

int wrap(int i, int count) {
    const int remainder = i % count;
    return remainder < 0 ? remainder + count : remainder;
}

/// Dot product of the lattice point's gradient (one of 256 directions) and the offset from it.
float gradientDot(int x, int y, std::uint32_t seed, float dx, float dy) {
    const auto direction = static_cast<float>(latticeHash(x, y, seed) >> 24);
    const float angle = direction * (2.0f * std::numbers::pi_v<float> / 256.0f);
    return std::cos(angle) * dx + std::sin(angle) * dy;
}

float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

} // namespace

std::uint32_t latticeHash(int x, int y, std::uint32_t seed) {
    // Odd multipliers spread the inputs; xor-shifts between multiplications mix all bits.
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u +
                      static_cast<std::uint32_t>(y) * 0x85ebca77u + seed * 0xc2b2ae3du;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return h ^ (h >> 15);
}

float latticeRandom(int x, int y, std::uint32_t seed) {
    return static_cast<float>(latticeHash(x, y, seed) >> 8) * (1.0f / 16777216.0f);
}

float gradientNoise(glm::vec2 uv, int cells, std::uint32_t seed) {
    const float px = uv.x * static_cast<float>(cells);
    const float py = uv.y * static_cast<float>(cells);
    const float fx = std::floor(px);
    const float fy = std::floor(py);
    const float dx = px - fx;
    const float dy = py - fy;
    const int x0 = wrap(static_cast<int>(fx), cells);
    const int y0 = wrap(static_cast<int>(fy), cells);
    const int x1 = wrap(x0 + 1, cells);
    const int y1 = wrap(y0 + 1, cells);
    const float wx = fade(dx);
    const float wy = fade(dy);
    const float top =
        std::lerp(gradientDot(x0, y0, seed, dx, dy), gradientDot(x1, y0, seed, dx - 1.0f, dy), wx);
    const float bottom = std::lerp(gradientDot(x0, y1, seed, dx, dy - 1.0f),
                                   gradientDot(x1, y1, seed, dx - 1.0f, dy - 1.0f), wx);
    return std::lerp(top, bottom, wy);
}

float fractalNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed) {
    float sum = 0.0f;
    float amplitude = 1.0f;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude *
               gradientNoise(uv, cells << octave, seed + static_cast<std::uint32_t>(octave) * 101u);
        amplitude *= 0.5f;
    }
    return sum;
}

glm::vec2 warpNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed) {
    return {fractalNoise(uv, cells, octaves, seed), fractalNoise(uv, cells, octaves, seed + 7919u)};
}

CellularSample cellularNoise(glm::vec2 uv, int cells, std::uint32_t seed) {
    const float px = uv.x * static_cast<float>(cells);
    const float py = uv.y * static_cast<float>(cells);
    const int cx = static_cast<int>(std::floor(px));
    const int cy = static_cast<int>(std::floor(py));
    CellularSample sample{1e9f, 1e9f, 0};
    // Two cells around: a neighbor's point may be nearer than the own cell's.
    for (int y = cy - 2; y <= cy + 2; ++y) {
        for (int x = cx - 2; x <= cx + 2; ++x) {
            const int wx = wrap(x, cells);
            const int wy = wrap(y, cells);
            const float dx = static_cast<float>(x) + latticeRandom(wx, wy, seed) - px;
            const float dy = static_cast<float>(y) + latticeRandom(wx, wy, seed + 1u) - py;
            const float distance = std::sqrt(dx * dx + dy * dy);
            if (distance < sample.nearest) {
                sample.second = sample.nearest;
                sample.nearest = distance;
                sample.id = latticeHash(wx, wy, seed + 2u);
            } else {
                sample.second = std::min(sample.second, distance);
            }
        }
    }
    return sample;
}

float smoothStep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace celadon::subedit
