#pragma once

/// Moments M_0 and M_1 of log_linear.h for |z| < 0.3, to 1e-6, in single precision: there their
/// closed forms lose all digits.
namespace celadon::subedit {

[[nodiscard]] inline float momentSeries0(float z) {
    return 1.0f + z * (1.0f / 2 + z * (1.0f / 6 + z * (1.0f / 24 + z * (1.0f / 120))));
}

[[nodiscard]] inline float momentSeries1(float z) {
    return 1.0f / 2 + z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z * (1.0f / 144))));
}

} // namespace celadon::subedit
