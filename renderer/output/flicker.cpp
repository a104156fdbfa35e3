#include "renderer/output/flicker.h"

#include "subedit/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace celadon {

namespace {

[[maybe_unused]] bool haveOneShape(const FramePair& judged, const FramePair& truth) {
    const FloatImage& shape = judged.before;
    return std::ranges::all_of(
        std::initializer_list<const FloatImage*>{&judged.after, &truth.before, &truth.after},
        [&shape](const FloatImage* image) {
            return image->width == shape.width && image->height == shape.height &&
                   image->channels == shape.channels;
        });
}

double changeOf(const FramePair& pair, std::size_t value) {
    return static_cast<double>(pair.after.pixels[value]) -
           static_cast<double>(pair.before.pixels[value]);
}

double relativeRoot(double squares, double truthSquares) {
    if (squares == 0.0) {
        return 0.0;
    }
    return truthSquares > 0.0 ? std::sqrt(squares / truthSquares)
                              : std::numeric_limits<double>::infinity();
}

} // namespace

Flicker measureFlicker(const FramePair& judged, const FramePair& truth) {
    CELADON_ASSERT(haveOneShape(judged, truth));
    double beyond = 0.0;
    double change = 0.0;
    double values = 0.0;
    for (std::size_t i = 0; i < truth.before.pixels.size(); ++i) {
        const double trueChange = changeOf(truth, i);
        const double excess = changeOf(judged, i) - trueChange;
        const double before = truth.before.pixels[i];
        const double after = truth.after.pixels[i];
        beyond += excess * excess;
        change += trueChange * trueChange;
        values += 0.5 * (before * before + after * after);
    }
    return {relativeRoot(change, values), relativeRoot(beyond, values)};
}

FloatImage flickerMap(const FramePair& judged, const FramePair& truth) {
    CELADON_ASSERT(haveOneShape(judged, truth));
    FloatImage map;
    map.width = truth.before.width;
    map.height = truth.before.height;
    map.channels = {"error"};
    const std::size_t stride = truth.before.channelCount();
    map.pixels.assign(stride == 0 ? 0 : truth.before.pixels.size() / stride, 0.0f);
    for (std::size_t i = 0; i < truth.before.pixels.size(); ++i) {
        float& largest = map.pixels[i / stride];
        const double excess = std::abs(changeOf(judged, i) - changeOf(truth, i));
        largest = std::max(largest, static_cast<float>(excess));
    }
    return map;
}

} // namespace celadon
