#pragma once

#include "renderer/output/image.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// Picture files, through OpenImageIO. EXR holds linear floats with any channels; PNG, JPEG and
/// TIFF hold display-encoded (sRGB) R,G,B and perhaps A. Written atomically (atomic_file.h).
namespace celadon {

enum class ImageFormat { Exr, Png, Jpeg, Tiff };

/// By the extension, any case. @throws UsageError for an unknown or missing one, listing the known
[[nodiscard]] ImageFormat imageFormat(const std::filesystem::path& file);

/// JPEG cannot hold transparency: give such a picture a background first.
[[nodiscard]] bool holdsAlpha(ImageFormat format);

/// Text attributes of the file: name and value.
using ImageAttributes = std::vector<std::pair<std::string, std::string>>;

struct ExrSettings {
    bool halfColor = false; ///< R, G, B and A as 16-bit halves; other channels are always floats
    ImageAttributes attributes{};
};

/// One zip-compressed part, channels under their own names. Values are stored as they are,
/// infinities and NaN too. @param file its extension must be .exr
/// @throws UsageError, OutputError
void writeExr(const std::filesystem::path& file, const FloatImage& image,
              const ExrSettings& settings = {});

struct DisplayFileSettings {
    int bits = 8;         ///< 8, or 16 for PNG and TIFF
    int jpegQuality = 95; ///< 1..100
    ImageAttributes attributes{};
};

/// PNG, JPEG or TIFF by the extension.
/// @param image display-encoded values in [0, 1] (outside is clamped, NaN is 0): R,G,B and perhaps
///              A, with R,G,B not premultiplied (tone_map.h: toDisplay())
/// @throws UsageError (extension; A in a JPEG; other channels; bits), OutputError
void writeDisplayImage(const std::filesystem::path& file, const FloatImage& image,
                       const DisplayFileSettings& settings = {});

struct ReadImage {
    FloatImage image; ///< linear; where there is an A, premultiplied as in an EXR
    /// The file held integers that were decoded from sRGB (unless it calls itself linear).
    bool displayEncoded = false;
};

/// Any format that OpenImageIO knows; of several parts the first. Channels keep their names (gray:
/// "Y"), with R,G,B,A first and in this order. An EXR data window is placed in its display window:
/// pixels outside the data are 0, data outside the display are cut off.
/// Sizes are checked against the file's length before anything is allocated. NaN and infinities
/// pass: see findNonFinite().
/// @throws InputError naming the file and what is wrong with it
[[nodiscard]] ReadImage readImage(const std::filesystem::path& file);

} // namespace celadon
