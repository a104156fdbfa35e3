#include "subedit/map/material_file.h"

#include "subedit/assert.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/exr_header.h"
#include "subedit/map/half_rounding.h"
#include "subedit/radius_map.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

constexpr int kFileVersion = 1;
constexpr float kMaxLogProfile = 40.0f; ///< e^40 per mm^2: no profile, whatever its radius
constexpr float kMinRadiusMm = 1e-6f;
constexpr float kMaxRadiusMm = 1e6f;      ///< a kilometer
constexpr int kBandRows = 64;             ///< rows read or written at a time
constexpr float kAlbedoTolerance = 1e-3f; ///< half precision may exceed 1 by so much

const char* const kComponents[] = {"R", "G", "B"};

std::string channelOf(int knot, int component) {
    return fmt::format("P{:02}.{}", knot, kComponents[component]);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& part, const std::string& reason,
                         const std::string& remedy = {}) {
    throw InputError(part.empty() ? fmt::format("'{}'", file.string())
                                  : fmt::format("'{}', {}", file.string(), part),
                     reason, remedy);
}

bool isStorable(float maxRadiusMm) {
    return maxRadiusMm >= kMinRadiusMm && maxRadiusMm <= kMaxRadiusMm;
}

/// The scalars of the file, checked; maps are still empty.
MaterialMap readAttributes(const fs::path& file, const ExrHeader& header) {
    MaterialMap map;
    const int version = header.intAttribute(file, "subedit:version");
    if (version != kFileVersion) {
        refuse(file, "attribute 'subedit:version'",
               fmt::format("is {}, and this program reads version {}", version, kFileVersion),
               version > kFileVersion ? "use a newer Celadon" : "");
    }
    map.segments = header.intAttribute(file, "subedit:segments");
    if (map.segments < 1 || map.segments > kMaxSegments) {
        refuse(file, "attribute 'subedit:segments'",
               fmt::format("is {}, not in 1..{}", map.segments, kMaxSegments));
    }
    map.maxRadiusMm = header.floatAttribute(file, "subedit:maxRadius");
    if (!isStorable(map.maxRadiusMm)) {
        refuse(file, "attribute 'subedit:maxRadius'",
               fmt::format("is {}, not a length in millimeters in [1e-6, 1e6]", map.maxRadiusMm));
    }
    map.eta = header.floatAttribute(file, "subedit:eta");
    if (!(map.eta >= 0.5f && map.eta <= 4.0f)) {
        refuse(file, "attribute 'subedit:eta'",
               fmt::format("is {}, not an index of refraction in [0.5, 4]", map.eta));
    }
    map.name = header.stringAttribute(file, "subedit:name");
    map.width = header.width;
    map.height = header.height;
    return map;
}

void checkChannels(const fs::path& file, const ExrHeader& header, int segments) {
    for (int k = 0; k <= segments; ++k) {
        for (int component = 0; component < 3; ++component) {
            const std::string name = channelOf(k, component);
            const auto found = header.channels.find(name);
            if (found == header.channels.end()) {
                refuse(
                    file, fmt::format("channel '{}'", name), "is missing",
                    fmt::format("'subedit:segments' = {} needs P00 to P{:02}", segments, segments));
            }
            if (found->second == ExrHeader::PixelType::Uint) {
                refuse(file, fmt::format("channel '{}'", name), "is integer, not half or float");
            }
        }
    }
    // Profiles cut short would be read as if they were whole.
    for (int k = segments + 1; k <= kMaxSegments; ++k) {
        for (int component = 0; component < 3; ++component) {
            const std::string name = channelOf(k, component);
            if (header.channels.contains(name)) {
                refuse(file, fmt::format("channel '{}'", name), "is one too many",
                       fmt::format("'subedit:segments' = {} ends at P{:02}", segments, segments));
            }
        }
    }
}

/// Where each value of a texel lies among the file's channels.
struct ChannelOrder {
    std::vector<int> profile; ///< (segments + 1) x 3
    int roughness = -1;
    int specular = -1;
};

ChannelOrder channelOrder(const OIIO::ImageSpec& spec, int segments) {
    ChannelOrder order;
    for (int k = 0; k <= segments; ++k) {
        for (int component = 0; component < 3; ++component) {
            order.profile.push_back(spec.channelindex(channelOf(k, component)));
        }
    }
    order.roughness = spec.channelindex("roughness");
    order.specular = spec.channelindex("specular");
    return order;
}

/// Finite (a comparison with NaN is false) and possible.
bool isLogProfile(float value) {
    return value >= -std::numeric_limits<float>::max() && value <= kMaxLogProfile;
}

/// Copies one row of pixels, and refuses what no profile may hold.
class RowReader {
public:
    RowReader(const fs::path& file, const ChannelOrder& order, int channels, MaterialMap& map)
        : mFile(file), mOrder(order), mChannels(static_cast<std::size_t>(channels)), mMap(map) {}

    void read(const float* row, int y) {
        const std::size_t values = mOrder.profile.size();
        const std::size_t base = mMap.logProfile.size();
        mMap.logProfile.resize(base + values * static_cast<std::size_t>(mMap.width));
        float* out = mMap.logProfile.data() + base;
        for (int x = 0; x < mMap.width; ++x, row += mChannels, out += values) {
            bool isGood = true;
            for (std::size_t i = 0; i < values; ++i) {
                const float value = row[mOrder.profile[i]];
                isGood &= isLogProfile(value);
                out[i] = std::max(value, kLogProfileFloor);
            }
            if (!isGood) {
                refuseTexel(row, x, y);
            }
            readUnit(row, mOrder.roughness, "roughness", x, y, mMap.roughness);
            readUnit(row, mOrder.specular, "specular", x, y, mMap.specular);
        }
    }

    /// Values of roughness and specular that were brought into [0, 1].
    [[nodiscard]] std::size_t clamped() const { return mClamped; }

private:
    [[noreturn]] void refuseTexel(const float* row, int x, int y) const {
        for (std::size_t i = 0; i < mOrder.profile.size(); ++i) {
            const float value = row[mOrder.profile[i]];
            if (!isLogProfile(value)) {
                refuse(mFile,
                       fmt::format("channel '{}'",
                                   channelOf(static_cast<int>(i / 3), static_cast<int>(i % 3))),
                       std::isfinite(value)
                           ? fmt::format("holds ln P = {} at texel ({}, {}): over {} is no profile",
                                         value, x, y, kMaxLogProfile)
                           : fmt::format("is not finite at texel ({}, {})", x, y));
            }
        }
        refuse(mFile, "", "holds values that are not finite");
    }

    void readUnit(const float* row, int channel, const char* name, int x, int y,
                  std::vector<float>& out) {
        if (channel < 0) {
            return;
        }
        const float value = row[channel];
        if (!std::isfinite(value)) {
            refuse(mFile, fmt::format("channel '{}'", name),
                   fmt::format("is not finite at texel ({}, {})", x, y));
        }
        out.push_back(std::clamp(value, 0.0f, 1.0f));
        mClamped += out.back() != value ? 1 : 0;
    }

    const fs::path& mFile;
    const ChannelOrder& mOrder;
    std::size_t mChannels;
    MaterialMap& mMap;
    std::size_t mClamped = 0;
};

/// @return how many values of roughness and specular were brought into [0, 1]
std::size_t readPixels(const fs::path& file, MaterialMap& map) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) {
        refuse(file, "", "cannot be read: " + OIIO::geterror());
    }
    const OIIO::ImageSpec spec = input->spec();
    const ChannelOrder order = channelOrder(spec, map.segments);
    if (spec.width != map.width || spec.height != map.height ||
        std::ranges::count(order.profile, -1) != 0) {
        refuse(file, "", "has a header that contradicts itself");
    }
    const int bandRows = spec.tile_height > 0 ? spec.tile_height : kBandRows;
    std::vector<float> band;
    RowReader rows(file, order, spec.nchannels, map);
    // The map grows with what really was in the file.
    for (int y = 0; y < spec.height; y += bandRows) {
        const int end = std::min(y + bandRows, spec.height);
        const std::size_t rowValues =
            static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
        band.resize(rowValues * static_cast<std::size_t>(end - y));
        const bool isRead =
            spec.tile_width > 0
                ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, 0,
                                    1, 0, spec.nchannels, OIIO::TypeFloat, band.data())
                : input->read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, spec.nchannels,
                                        OIIO::TypeFloat, band.data());
        if (!isRead) {
            refuse(file, fmt::format("rows {} to {}", y, end - 1),
                   "cannot be read: " + input->geterror(),
                   "it is damaged or was cut short: fetch or bake it again");
        }
        for (int row = y; row < end; ++row) {
            rows.read(band.data() + rowValues * static_cast<std::size_t>(row - y), row);
        }
    }
    return rows.clamped();
}

void reportAlbedo(const MaterialMap& map, std::vector<std::string>& warnings) {
    const std::vector<float> albedo = albedoMap(map);
    std::size_t count = 0;
    float largest = 0.0f;
    std::size_t where = 0;
    for (std::size_t texel = 0; texel * 3 < albedo.size(); ++texel) {
        const float value =
            std::max({albedo[texel * 3], albedo[texel * 3 + 1], albedo[texel * 3 + 2]});
        count += value > 1.0f + kAlbedoTolerance ? 1 : 0;
        if (value > largest) {
            largest = value;
            where = texel;
        }
    }
    if (count > 0) {
        const auto width = static_cast<std::size_t>(map.width);
        warnings.push_back(fmt::format("{} of {} profiles have an albedo above 1: they give more "
                                       "light than they take; the largest, {:.4g}, is at texel "
                                       "({}, {})",
                                       count, albedo.size() / 3, largest, where % width,
                                       where / width));
    }
}

OIIO::ImageSpec fileSpec(const MaterialMap& map, StoredPrecision precision) {
    OIIO::ImageSpec spec(map.width, map.height, 0,
                         precision == StoredPrecision::Half ? OIIO::TypeHalf : OIIO::TypeFloat);
    for (int k = 0; k < map.knots(); ++k) {
        for (int component = 0; component < 3; ++component) {
            spec.channelnames.push_back(channelOf(k, component));
        }
    }
    if (!map.roughness.empty()) {
        spec.channelnames.emplace_back("roughness");
    }
    if (!map.specular.empty()) {
        spec.channelnames.emplace_back("specular");
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.attribute("compression", "zip");
    spec.attribute("Software", "Celadon");
    spec.attribute("DateTime", kNoDate);
    spec.attribute("subedit:version", kFileVersion);
    spec.attribute("subedit:segments", map.segments);
    spec.attribute("subedit:maxRadius", map.maxRadiusMm);
    spec.attribute("subedit:eta", map.eta);
    spec.attribute("subedit:name", map.name);
    return spec;
}

/// Bits of a value in [0, 1] in half precision, rounded to nearest.
std::uint16_t unitHalf(float value) {
    if (!(value > 6.103515625e-5f)) { // 2^-14, the smallest normal half
        return 0;
    }
    const int exponent = std::ilogb(std::min(value, 1.0f));
    const float step = std::ldexp(1.0f, exponent - 10);
    const auto mantissa = static_cast<int>(std::lround(std::min(value, 1.0f) / step)); // 1024..2048
    return static_cast<std::uint16_t>(((exponent + 15) << 10) + (mantissa - 1024));
}

void checkMap(const MaterialMap& map) {
    const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    CELADON_ASSERT(map.width > 0 && map.height > 0);
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments && map.maxRadiusMm > 0.0f);
    CELADON_ASSERT(map.logProfile.size() == texels * static_cast<std::size_t>(map.knots()) * 3);
    CELADON_ASSERT(map.roughness.empty() || map.roughness.size() == texels);
    CELADON_ASSERT(map.specular.empty() || map.specular.size() == texels);
    static_cast<void>(texels);
}

/// Pixels of rows [begin, end) in the file's order of channels, as floats.
void packFloats(const MaterialMap& map, std::size_t begin, std::size_t end, std::size_t channels,
                std::vector<float>& out) {
    const auto values = static_cast<std::size_t>(map.knots()) * 3;
    out.resize((end - begin) * channels);
    float* pixel = out.data();
    for (std::size_t texel = begin; texel < end; ++texel, pixel += channels) {
        for (std::size_t i = 0; i < values; ++i) {
            pixel[i] = std::max(map.logProfile[texel * values + i], kLogProfileFloor);
        }
        std::size_t next = values;
        if (!map.roughness.empty()) {
            pixel[next++] = map.roughness[texel];
        }
        if (!map.specular.empty()) {
            pixel[next] = map.specular[texel];
        }
    }
}

/// Rounding looks at every profile as a whole, and takes longer than the compression: on all cores.
void packHalves(const MaterialMap& map, std::size_t begin, std::size_t end, std::size_t channels,
                std::vector<std::uint16_t>& out) {
    const auto values = static_cast<std::size_t>(map.knots()) * 3;
    out.resize((end - begin) * channels);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {
        HalfRounding rounding(map.segments, map.maxRadiusMm / static_cast<float>(map.segments));
        std::vector<float> floored(values);
        for (std::size_t texel = range.begin(); texel < range.end(); ++texel) {
            std::uint16_t* pixel = out.data() + (texel - begin) * channels;
            for (std::size_t i = 0; i < values; ++i) {
                floored[i] = std::clamp(map.logProfile[texel * values + i], kLogProfileFloor,
                                        kMaxLogProfile);
            }
            rounding.round(floored.data(), pixel);
            std::size_t next = values;
            if (!map.roughness.empty()) {
                pixel[next++] = unitHalf(map.roughness[texel]);
            }
            if (!map.specular.empty()) {
                pixel[next] = unitHalf(map.specular[texel]);
            }
        }
    });
}

} // namespace

MaterialMap readMaterial(const fs::path& file) {
    return readMaterial(file, nullptr);
}

MaterialMap readMaterial(const fs::path& file, std::vector<std::string>* warnings) {
    const ExrHeader header = readExrHeader(file);
    MaterialMap map = readAttributes(file, header);
    checkChannels(file, header, map.segments);
    const std::size_t clamped = readPixels(file, map);
    if (warnings != nullptr) {
        reportAlbedo(map, *warnings);
        if (clamped > 0) {
            warnings->push_back(fmt::format(
                "{} values of roughness and specular are outside 0 to 1 and were clamped",
                clamped));
        }
    }
    return map;
}

void writeMaterial(const MaterialMap& map, const fs::path& file, StoredPrecision precision) {
    checkMap(map);
    AtomicFile target(file);
    const auto fail = [&](const std::string& reason) {
        throw OutputError(fmt::format("'{}'", file.string()), "cannot be written: " + reason);
    };
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".exr") {
        fail("the name does not end in .exr");
    }
    if (!isStorable(map.maxRadiusMm)) {
        fail(fmt::format("its profiles reach {:.4g} mm, and 1e-6 to 1e6 can be stored",
                         map.maxRadiusMm));
    }
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    if (!output) {
        fail(OIIO::geterror());
    }
    const OIIO::ImageSpec spec = fileSpec(map, precision);
    if (!output->open(target.temporaryPath().string(), spec)) {
        fail(output->geterror());
    }
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> floats;
    std::vector<std::uint16_t> halves;
    for (int y = 0; y < map.height; y += kBandRows) {
        const int end = std::min(y + kBandRows, map.height);
        const auto firstTexel = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
        const auto endTexel = static_cast<std::size_t>(end) * static_cast<std::size_t>(map.width);
        const void* pixels = nullptr;
        if (precision == StoredPrecision::Half) {
            packHalves(map, firstTexel, endTexel, channels, halves);
            pixels = halves.data();
        } else {
            packFloats(map, firstTexel, endTexel, channels, floats);
            pixels = floats.data();
        }
        if (!output->write_scanlines(y, end, 0, spec.format, pixels)) {
            fail(output->geterror());
        }
    }
    if (!output->close()) {
        fail(output->geterror());
    }
    target.commit();
}

} // namespace celadon::subedit
