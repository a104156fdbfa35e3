#include "renderer/scene/keyed_numbers.h"

#include "renderer/scene/animation.h"
#include "subedit/assert.h"

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// Slope at a key of the parabola through it and its neighbors; at an end that of the line.
double slopeAt(const KeyedNumbers& keys, std::size_t key, std::size_t component) {
    const auto slope = [&](std::size_t from) {
        const double dt = keys.times[from + 1] - keys.times[from];
        return (keys.values[(from + 1) * keys.components + component] -
                keys.values[from * keys.components + component]) /
               dt;
    };
    if (key == 0) {
        return slope(0);
    }
    if (key + 1 == keys.times.size()) {
        return slope(key - 1);
    }
    const double before = keys.times[key] - keys.times[key - 1];
    const double after = keys.times[key + 1] - keys.times[key];
    return (slope(key - 1) * after + slope(key) * before) / (before + after);
}

} // namespace

KeyedNumbers KeyedNumbers::of(std::span<const double> value) {
    KeyedNumbers result;
    result.components = value.size();
    result.values.assign(value.begin(), value.end());
    return result;
}

KeyedNumbers KeyedNumbers::of(const glm::dvec3& value) {
    return of(std::span(&value.x, 3));
}

void KeyedNumbers::sample(double seconds, std::span<double> result) const {
    CELADON_ASSERT(result.size() == components);
    const auto next = std::upper_bound(times.begin(), times.end(), seconds);
    const auto after = static_cast<std::size_t>(next - times.begin());
    if (after == 0 || after == times.size() || interpolation == Interpolation::Step) {
        const std::size_t key = after == 0 ? 0 : after - 1;
        std::copy_n(&values[key * components], components, result.begin());
        return;
    }
    const double dt = times[after] - times[after - 1];
    const double u = (seconds - times[after - 1]) / dt;
    for (std::size_t c = 0; c < components; ++c) {
        const double from = values[(after - 1) * components + c];
        const double to = values[after * components + c];
        result[c] = interpolation == Interpolation::Linear
                        ? std::lerp(from, to, u)
                        : hermite(from, dt * slopeAt(*this, after - 1, c), to,
                                  dt * slopeAt(*this, after, c), u);
    }
}

double KeyedNumbers::number(double seconds) const {
    double result = 0.0;
    sample(seconds, std::span(&result, 1));
    return result;
}

glm::dvec3 KeyedNumbers::vector(double seconds) const {
    glm::dvec3 result;
    sample(seconds, std::span(&result.x, 3));
    return result;
}

void KeyedNumbers::setKey(double seconds, std::span<const double> value) {
    CELADON_ASSERT(value.size() == components);
    const auto place = std::lower_bound(times.begin(), times.end(), seconds);
    const auto at = static_cast<std::ptrdiff_t>((place - times.begin()) *
                                                static_cast<std::ptrdiff_t>(components));
    if (times.empty()) {
        values.clear();
    } else if (place != times.end() && *place == seconds) {
        std::copy(value.begin(), value.end(), values.begin() + at);
        return;
    }
    values.insert(values.begin() + at, value.begin(), value.end());
    times.insert(place, seconds);
}

void KeyedNumbers::removeKey(std::size_t index) {
    CELADON_ASSERT(index < times.size());
    if (times.size() > 1) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(index * components);
        values.erase(at, at + static_cast<std::ptrdiff_t>(components));
    }
    times.erase(times.begin() + static_cast<std::ptrdiff_t>(index));
}

} // namespace celadon
