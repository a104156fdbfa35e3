// Reading environment maps: environment.h, readEnvironment.
#include "renderer/scene/environment.h"
#include "subedit/errors.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace celadon {

namespace {

constexpr int kMaxWidth = 16384;
constexpr int kMaxHeight = 8192;

/// Rows read at once: memory grows with what the file really holds, not with what its header says.
constexpr int kBandRows = 64;

class EnvironmentReader {
public:
    explicit EnvironmentReader(const std::filesystem::path& file)
        : mSubject(fmt::format("'{}'", file.string())) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) {
            fail("there is no such file", "check the path");
        }
        if (!std::filesystem::is_regular_file(file, error)) {
            fail("it is not a file", "name an .hdr or .exr file");
        }
        mInput = OIIO::ImageInput::open(file.string());
        if (!mInput) {
            const std::string reason = OIIO::geterror();
            fail(reason.empty() ? "it cannot be read" : oneLine(reason), kRemedy);
        }
        checkHeader();
    }

    [[nodiscard]] EnvironmentMap read() {
        const OIIO::ImageSpec& spec = mInput->spec();
        EnvironmentMap map;
        map.width = spec.width;
        map.height = spec.height;
        const auto channels = static_cast<std::size_t>(mEndChannel - mFirstChannel);
        const auto width = static_cast<std::size_t>(spec.width);
        const int bandRows =
            spec.tile_height > 0 ? std::clamp(spec.tile_height, 1, spec.height) : kBandRows;
        std::vector<float> band;
        for (int y = 0; y < spec.height; y += bandRows) {
            const int rows = std::min(bandRows, spec.height - y);
            band.resize(static_cast<std::size_t>(rows) * width * channels);
            readBand(y, y + rows, band.data());
            for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(rows) * width; ++pixel) {
                map.radiance.push_back(
                    checked(band.data() + pixel * channels, y, pixel, spec.width));
            }
            if (y == 0) {
                map.radiance.reserve(width * static_cast<std::size_t>(spec.height));
            }
        }
        addWarnings(map);
        return map;
    }

private:
    static constexpr const char* kRemedy =
        "give a latitude-longitude picture of radiance, .hdr or .exr with channels R, G and B";

    [[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) const {
        throw InputError(mSubject, reason, remedy);
    }

    static std::string oneLine(std::string text) {
        while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) {
            text.pop_back();
        }
        std::replace(text.begin(), text.end(), '\n', ' ');
        return text;
    }

    void checkHeader() {
        const OIIO::ImageSpec& spec = mInput->spec();
        const std::string format = mInput->format_name();
        if (format != "openexr" && format != "hdr") {
            fail(fmt::format("it is a picture of format '{}', which holds no radiance", format),
                 kRemedy);
        }
        if (spec.width < 1 || spec.height < 1 || spec.width > kMaxWidth ||
            spec.height > kMaxHeight || spec.depth > 1) {
            fail(fmt::format("{} x {} pixels are not supported", spec.width, spec.height),
                 fmt::format("scale it to at most {} x {}", kMaxWidth, kMaxHeight));
        }
        if (spec.deep) {
            fail("it holds deep pixels", kRemedy);
        }
        if (spec.full_width != spec.width || spec.full_height != spec.height ||
            spec.full_x != spec.x || spec.full_y != spec.y) {
            fail("it is cropped: its data window differs from its display window",
                 "write it whole");
        }
        if (spec.get_string_attribute("textureformat") == "CubeFace Environment") {
            fail("it is a cube map", kRemedy);
        }
        constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto found =
                std::find(spec.channelnames.begin(), spec.channelnames.end(), kNames[c]);
            if (found == spec.channelnames.end()) {
                fail(fmt::format("it has no channel '{}'", kNames[c]), kRemedy);
            }
            mChannel[c] = static_cast<int>(found - spec.channelnames.begin());
        }
        const auto [first, last] = std::minmax_element(mChannel.begin(), mChannel.end());
        mFirstChannel = *first;
        mEndChannel = *last + 1;
        if (mEndChannel - mFirstChannel > 1024) { // a band of rows must stay small
            fail(fmt::format("it has {} channels", spec.nchannels), kRemedy);
        }
    }

    void readBand(int begin, int end, float* pixels) {
        const OIIO::ImageSpec& spec = mInput->spec();
        const bool done =
            spec.tile_height > 0
                ? mInput->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + begin,
                                     spec.y + end, spec.z, spec.z + 1, mFirstChannel, mEndChannel,
                                     OIIO::TypeDesc::FLOAT, pixels)
                : mInput->read_scanlines(0, 0, spec.y + begin, spec.y + end, spec.z, mFirstChannel,
                                         mEndChannel, OIIO::TypeDesc::FLOAT, pixels);
        if (!done) {
            const std::string reason = oneLine(mInput->geterror());
            fail(fmt::format("its pixels cannot be read from row {}{}{}", begin,
                             reason.empty() ? "" : ": ", reason),
                 "the file may be truncated or damaged");
        }
    }

    glm::vec3 checked(const float* pixel, int firstRow, std::size_t indexInBand, int width) {
        glm::vec3 rgb;
        for (int c = 0; c < 3; ++c) {
            rgb[c] = pixel[mChannel[static_cast<std::size_t>(c)] - mFirstChannel];
        }
        if (!std::isfinite(rgb.x) || !std::isfinite(rgb.y) || !std::isfinite(rgb.z)) {
            const std::size_t x = indexInBand % static_cast<std::size_t>(width);
            const std::size_t y =
                static_cast<std::size_t>(firstRow) + indexInBand / static_cast<std::size_t>(width);
            fail(fmt::format("pixel ({}, {}) is NaN or infinite", x, y),
                 "repair it in a picture editor");
        }
        if (rgb.x < 0.0f || rgb.y < 0.0f || rgb.z < 0.0f) {
            ++mNegativePixels;
            mLeast = std::min({mLeast, rgb.x, rgb.y, rgb.z});
            rgb = glm::max(rgb, glm::vec3(0.0f));
        }
        return rgb;
    }

    void addWarnings(EnvironmentMap& map) const {
        if (mNegativePixels > 0) {
            map.warnings.push_back(
                fmt::format("{}: {} of {} pixels have a negative channel, down to {:g}; taken as 0",
                            mSubject, mNegativePixels, map.radiance.size(), mLeast));
        }
        if (map.width != 2 * map.height) {
            map.warnings.push_back(
                fmt::format("{}: {} x {} pixels are not twice as wide as high; "
                            "taken as a whole latitude-longitude map all the same",
                            mSubject, map.width, map.height));
        }
    }

    std::string mSubject;
    std::unique_ptr<OIIO::ImageInput> mInput;
    std::array<int, 3> mChannel{};
    int mFirstChannel = 0;
    int mEndChannel = 3;
    std::size_t mNegativePixels = 0;
    float mLeast = 0.0f;
};

} // namespace

EnvironmentMap readEnvironment(const std::filesystem::path& file) {
    return EnvironmentReader(file).read();
}

} // namespace celadon
