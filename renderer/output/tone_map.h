#pragma once

#include "renderer/output/image.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string_view>

/// From linear radiance to what a display shows, on the CPU: exposure, tone curve, background,
/// sRGB encoding. `shaders/tone_map.frag` does the same in the editor's viewport.
namespace celadon {

enum class ToneMap {
    Neutral, ///< Khronos PBR Neutral (2024): keeps base colors, compresses highlights only
    Aces,    ///< Narkowicz (2015), "ACES filmic tone mapping curve", a fit of RRT and sRGB ODT
    None     ///< clamps to [0, 1]
};

/// @throws UsageError for another word than neutral|aces|none
[[nodiscard]] ToneMap parseToneMap(std::string_view word);
[[nodiscard]] const char* toneMapName(ToneMap toneMap);

/// IEC 61966-2-1, the exact piecewise curve; the domain and the range are [0, 1], outside is
/// clamped. NaN gives 0.
[[nodiscard]] float encodeSrgb(float linear);
/// The inverse of encodeSrgb() on [0, 1].
[[nodiscard]] float decodeSrgb(float encoded);

/// The curve alone. @param color linear, after exposure; negative or NaN parts count as 0
/// @return linear, in [0, 1]
[[nodiscard]] glm::vec3 applyToneMap(ToneMap toneMap, glm::vec3 color);

/// What a display shows of a picture before black, as linear light in [0, 1]: what ssim and flip
/// look at. @param color linear, channels R,G,B only, premultiplied
[[nodiscard]] FloatImage toDisplayLight(FloatImage color, ToneMap toneMap, float exposureEv = 0.0f);

struct DisplaySettings {
    float exposureEv = 0.0f; ///< radiance is multiplied by 2^EV
    ToneMap toneMap = ToneMap::Neutral;
    /// Linear display color behind the object, neither exposed nor tone mapped: 1,1,1 is the
    /// display's white whatever the exposure. Unset: transparent.
    std::optional<glm::vec3> background;
};

/// @param linear R,G,B and perhaps A (coverage), premultiplied; further channels are ignored
/// @return sRGB-encoded values in [0, 1]: R,G,B where there is a background or no A, else
///         R,G,B,A with R,G,B *not* premultiplied, as PNG wants it
/// Object and background meet in linear display light, by coverage.
/// @throws UsageError when R, G or B is missing
[[nodiscard]] FloatImage toDisplay(const FloatImage& linear, const DisplaySettings& settings);

/// Places a premultiplied picture in front of a uniform linear background; the result is opaque
/// (A = 1 where there was an A). Other channels are kept. This is what an EXR with a background
/// holds. @throws UsageError when R, G or B is missing
[[nodiscard]] FloatImage compositeOver(FloatImage premultiplied, glm::vec3 background);

} // namespace celadon
