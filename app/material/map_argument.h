#pragma once

#include "subedit/map/image_map.h"

#include <string>

/// Maps as options give them: an image, or numbers.
namespace celadon::app {

/// An image or, if the text is numbers (R,G,B or one), one texel of them.
[[nodiscard]] subedit::ImageMap readMap(const std::string& text, subedit::ImageMeaning meaning);

/// @throws InputError naming the option, the channel and the pixel of a value outside [low, high];
/// UsageError where the text is the value
void checkRange(const std::string& option, const std::string& text, const subedit::ImageMap& map,
                float low, float high);

/// @throws UsageError: profiles of so many texels would take more than 4 GB
void checkMapMemory(const std::string& command, double texels, int segments);

/// IEC 61966-2-1, for images whose encoding is known better than their file says.
void decodeSrgb(subedit::ImageMap& map);

} // namespace celadon::app
