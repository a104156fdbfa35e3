#include "app/material/response_table.h"

#include "subedit/errors.h"
#include "subedit/map/image_map.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

namespace celadon::app {

using namespace subedit;

namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos
               ? std::string_view{}
               : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void splitRow(std::string_view row, std::vector<std::string_view>& cells) {
    cells.clear();
    for (;;) {
        const std::size_t comma = row.find(',');
        cells.push_back(trim(row.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return;
        }
        row.remove_prefix(comma + 1);
    }
}

/// Calls take(cells, line) for each row that is not empty and no comment.
template<typename Take>
void forEachRow(std::string_view text, const Take& take) {
    std::vector<std::string_view> cells;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view row = trim(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (!row.empty() && !row.starts_with('#')) {
            splitRow(row, cells);
            take(cells, line);
        }
    }
}

std::optional<float> toNumber(std::string_view cell) {
    float value = 0.0f;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

/// Where the header has each column; -1 where it has not.
class Columns {
public:
    Columns(const std::vector<std::string_view>& header, const std::string& name) {
        const auto find = [&](std::string_view column) {
            const auto at = std::ranges::find(header, column);
            return at == header.end() ? -1 : static_cast<int>(at - header.begin());
        };
        for (std::size_t i = 0; i < kNames.size(); ++i) {
            mIndex[i] = find(kNames[i]);
        }
        for (std::size_t i = 0; i < 7; ++i) {
            if (mIndex[i] < 0) {
                throw InputError(fmt::format("'{}', line 1", name),
                                 fmt::format("has no column {}", kNames[i]),
                                 "a header u_in,v_in,u_out,v_out,r_mm,R,G,B is needed");
            }
        }
        const bool hasPositions = std::ranges::count(mIndex.begin() + 8, mIndex.end(), -1) == 0;
        if (mIndex[kDistance] < 0 && !hasPositions) {
            throw InputError(fmt::format("'{}', line 1", name),
                             "has neither a column r_mm nor all of x_in,y_in,z_in,x_out,y_out,"
                             "z_out");
        }
    }

    [[nodiscard]] ResponseSample read(const std::vector<std::string_view>& cells, int line,
                                      const std::string& name) const {
        const auto number = [&](std::size_t i) {
            const auto column = static_cast<std::size_t>(mIndex[i]);
            if (column >= cells.size()) {
                throw InputError(fmt::format("'{}', line {}", name, line),
                                 fmt::format("has no column {}", kNames[i]));
            }
            const std::optional<float> value = toNumber(cells[column]);
            if (!value) {
                throw InputError(
                    fmt::format("'{}', line {}", name, line),
                    fmt::format("{} is '{}', no finite number", kNames[i], cells[column]));
            }
            return *value;
        };
        ResponseSample sample{{number(0), number(1)},
                              {number(2), number(3)},
                              0.0f,
                              {number(4), number(5), number(6)}};
        for (int channel = 0; channel < 3; ++channel) {
            if (sample.response[channel] < 0.0f) {
                throw InputError(fmt::format("'{}', line {}", name, line),
                                 fmt::format("response {} is negative", sample.response[channel]));
            }
        }
        sample.distanceMm = mIndex[kDistance] >= 0
                                ? number(kDistance)
                                : glm::distance(glm::vec3(number(8), number(9), number(10)),
                                                glm::vec3(number(11), number(12), number(13)));
        if (sample.distanceMm < 0.0f) {
            throw InputError(fmt::format("'{}', line {}", name, line),
                             fmt::format("distance {} is negative", sample.distanceMm));
        }
        return sample;
    }

private:
    static constexpr std::size_t kDistance = 7;
    static constexpr std::array<std::string_view, 14> kNames{
        "u_in", "v_in", "u_out", "v_out", "R",     "G",     "B",
        "r_mm", "x_in", "y_in",  "z_in",  "x_out", "y_out", "z_out"};
    std::array<int, kNames.size()> mIndex{};
};

struct LitImage {
    std::filesystem::path file;
    glm::vec2 uv;
};

std::vector<LitImage> readList(const std::filesystem::path& list) {
    std::vector<LitImage> images;
    const std::string text = readTextFile(list);
    forEachRow(text, [&](const std::vector<std::string_view>& cells, int line) {
        const auto u = cells.size() == 3 ? toNumber(cells[1]) : std::nullopt;
        const auto v = cells.size() == 3 ? toNumber(cells[2]) : std::nullopt;
        if (!u && images.empty() && line == 1) {
            return; // a header
        }
        if (!u || !v) {
            throw InputError(fmt::format("'{}', line {}", list.string(), line), "is not file,u,v");
        }
        images.push_back({list.parent_path() / std::string(cells[0]), {*u, *v}});
    });
    if (images.empty()) {
        throw InputError(fmt::format("'{}'", list.string()), "lists no images",
                         "give rows file,u,v");
    }
    return images;
}

} // namespace

std::string readTextFile(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        throw InputError(fmt::format("'{}'", file.string()), "no such file");
    }
    if (std::filesystem::file_size(file, ignored) > kLargestFile) {
        throw InputError(fmt::format("'{}'", file.string()), "is over 1 GB");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), {});
    if (stream.bad()) {
        throw InputError(fmt::format("'{}'", file.string()), "cannot be read");
    }
    return text;
}

std::vector<ResponseSample> parseResponseCsv(std::string_view text, const std::string& name) {
    std::vector<ResponseSample> samples;
    std::optional<Columns> columns;
    forEachRow(text, [&](const std::vector<std::string_view>& cells, int line) {
        if (!columns) {
            columns.emplace(cells, name);
        } else {
            samples.push_back(columns->read(cells, line, name));
        }
    });
    if (samples.empty()) {
        throw InputError(fmt::format("'{}'", name), "holds no rows of responses",
                         "give a header u_in,v_in,u_out,v_out,r_mm,R,G,B and rows");
    }
    return samples;
}

std::vector<ResponseSample> readResponseImages(const std::filesystem::path& list,
                                               const ResponseImages& settings) {
    std::vector<ResponseSample> samples;
    glm::ivec2 size(0);
    std::string firstFile;
    const std::vector<LitImage> images = readList(list);
    for (const LitImage& lit : images) {
        const ImageMap image = readImageMap(lit.file, ImageMeaning::Color);
        if (firstFile.empty()) {
            size = {image.width, image.height};
            firstFile = lit.file.string();
        } else if (size != glm::ivec2(image.width, image.height)) {
            throw InputError(fmt::format("'{}'", lit.file.string()),
                             fmt::format("is {} x {}, but '{}' is {} x {}", image.width,
                                         image.height, firstFile, size.x, size.y));
        }
        float brightest = 0.0f;
        for (const glm::vec3& value : image.values) {
            brightest = std::max({brightest, value.x, value.y, value.z});
        }
        const auto threshold = static_cast<float>(settings.darkest) * brightest;
        const std::size_t share = std::max<std::size_t>(settings.mostSamples / images.size(), 1);
        const std::size_t every = (image.values.size() + share - 1) / share;
        const double heightMm = settings.extentMm * size.y / size.x;
        for (std::size_t i = 0; i < image.values.size(); i += every) {
            const glm::vec3& value = image.values[i];
            if (std::max({value.x, value.y, value.z}) <= threshold) {
                continue;
            }
            const auto width = static_cast<std::size_t>(image.width);
            const glm::vec2 uv((static_cast<float>(i % width) + 0.5f) / static_cast<float>(size.x),
                               (static_cast<float>(i / width) + 0.5f) / static_cast<float>(size.y));
            const glm::dvec2 apart =
                glm::dvec2(uv - lit.uv) * glm::dvec2(settings.extentMm, heightMm);
            samples.push_back({lit.uv, uv, static_cast<float>(glm::length(apart)),
                               value * static_cast<float>(settings.scale)});
        }
    }
    return samples;
}

} // namespace celadon::app
