#include "subedit/map/range_table_file.h"

#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMeanHeader = "r,meanProfile";
constexpr const char* kRadiusHeader = "T,minimalRadius";
constexpr std::uintmax_t kLargestFile = 16u << 20;
constexpr int kWidestExr = 65536;
constexpr int kExrWidth = 512;

[[noreturn]] void refuse(const std::string& where, const std::string& reason) {
    throw InputError(where, reason, "make it again with 'celadon profile table'");
}

/// Linear between samples that rise, constant beyond.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto above = std::ranges::upper_bound(x, at);
    const auto next = static_cast<std::size_t>(above - x.begin());
    if (next == 0 || next == x.size()) {
        return next == 0 ? y.front() : y.back();
    }
    const double t = (at - x[next - 1]) / (x[next] - x[next - 1]);
    return std::lerp(y[next - 1], y[next], t);
}

std::optional<std::pair<double, double>> twoNumbers(std::string_view row) {
    const std::size_t comma = row.find(',');
    if (comma == std::string_view::npos) {
        return std::nullopt;
    }
    const auto number = [](std::string_view cell) -> std::optional<double> {
        double value = 0.0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) {
            return std::nullopt;
        }
        return value;
    };
    const auto first = number(row.substr(0, comma));
    const auto second = number(row.substr(comma + 1));
    return first && second ? std::optional(std::pair{*first, *second}) : std::nullopt;
}

/// What rendering relies on.
void checkRadii(const TableFile& table, const std::string& name) {
    if (table.T.empty()) {
        refuse(fmt::format("'{}'", name), "holds no minimal radii");
    }
    for (std::size_t i = 0; i < table.T.size(); ++i) {
        if (!(table.T[i] > 0.0) || (i > 0 && table.T[i] <= table.T[i - 1])) {
            refuse(fmt::format("'{}', entry {}", name, i + 1),
                   fmt::format("T = {} is not positive and rising", table.T[i]));
        }
        if (!(table.minimalRadius[i] >= 0.0 && table.minimalRadius[i] <= 1.0)) {
            refuse(fmt::format("'{}', entry {}", name, i + 1),
                   fmt::format("minimal radius {} is not in [0, 1]", table.minimalRadius[i]));
        }
    }
}

TableFile readTableExr(const fs::path& file) {
    const std::string where = fmt::format("'{}'", file.string());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) {
        refuse(where, "is no image that can be read: " + OIIO::geterror());
    }
    const OIIO::ImageSpec spec = input->spec();
    const int meanChannel = spec.channelindex("meanProfile");
    const int radiusChannel = spec.channelindex("minimalRadius");
    const double minT = static_cast<double>(spec.get_float_attribute("celadon:minT", 0.0f));
    const double maxT = static_cast<double>(spec.get_float_attribute("celadon:maxT", 0.0f));
    if (meanChannel < 0 || radiusChannel < 0 || spec.height != 1 || spec.width < 2 ||
        spec.width > kWidestExr || spec.nchannels > 16 || !(minT > 0.0) || !(maxT > minT)) {
        refuse(where, "is no table: channels meanProfile and minimalRadius of one row, and "
                      "attributes celadon:minT and celadon:maxT are needed");
    }
    std::vector<float> row(static_cast<std::size_t>(spec.width) *
                           static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, row.data())) {
        refuse(where, "cannot be read: " + input->geterror());
    }
    TableFile table;
    table.epsilon = static_cast<double>(spec.get_float_attribute("celadon:epsilon", 0.0f));
    table.energy = static_cast<double>(spec.get_float_attribute("celadon:energy", 0.0f));
    for (int x = 0; x < spec.width; ++x) {
        const double t = static_cast<double>(x) / (spec.width - 1);
        const float* pixel = row.data() + x * spec.nchannels;
        table.r.push_back(t);
        table.meanProfile.push_back(static_cast<double>(pixel[meanChannel]));
        table.T.push_back(minT * std::pow(maxT / minT, t));
        table.minimalRadius.push_back(static_cast<double>(pixel[radiusChannel]));
    }
    checkRadii(table, file.string());
    return table;
}

} // namespace

std::string tableCsv(const TableFile& table) {
    std::string csv = std::string(kMeanHeader) + "\n";
    for (std::size_t i = 0; i < table.r.size(); ++i) {
        csv += fmt::format("{:.9g},{:.9g}\n", table.r[i], table.meanProfile[i]);
    }
    csv += fmt::format("\n{}\n", kRadiusHeader);
    for (std::size_t i = 0; i < table.T.size(); ++i) {
        csv += fmt::format("{:.9g},{:.9g}\n", table.T[i], table.minimalRadius[i]);
    }
    return csv;
}

TableFile parseTableCsv(std::string_view text, const std::string& name) {
    TableFile table;
    std::vector<double>* x = nullptr;
    std::vector<double>* y = nullptr;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        std::string_view row = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (row.ends_with('\r')) {
            row.remove_suffix(1);
        }
        if (row.empty() || row.starts_with('#')) {
            continue;
        }
        if (row == kMeanHeader || row == kRadiusHeader) {
            x = row == kMeanHeader ? &table.r : &table.T;
            y = row == kMeanHeader ? &table.meanProfile : &table.minimalRadius;
            continue;
        }
        const auto numbers = twoNumbers(row);
        if (x == nullptr || !numbers) {
            refuse(fmt::format("'{}', line {}", name, line),
                   x == nullptr ? fmt::format("is not '{}' or '{}'", kMeanHeader, kRadiusHeader)
                                : "is not two numbers with a comma between");
        }
        x->push_back(numbers->first);
        y->push_back(numbers->second);
    }
    checkRadii(table, name);
    return table;
}

void writeTableExr(const TableFile& table, const fs::path& file) {
    std::vector<double> logT;
    for (const double T : table.T) {
        logT.push_back(std::log2(T));
    }
    std::vector<float> row;
    for (int x = 0; x < kExrWidth; ++x) {
        const double t = static_cast<double>(x) / (kExrWidth - 1);
        row.push_back(static_cast<float>(interpolate(table.r, table.meanProfile, t)));
        row.push_back(static_cast<float>(
            interpolate(logT, table.minimalRadius, std::lerp(logT.front(), logT.back(), t))));
    }
    AtomicFile target(file);
    OIIO::ImageSpec spec(kExrWidth, 1, 2, OIIO::TypeFloat);
    spec.channelnames = {"meanProfile", "minimalRadius"};
    spec.attribute("compression", "zip");
    spec.attribute("Software", "Celadon");
    spec.attribute("DateTime", kNoDate);
    spec.attribute("celadon:minT", static_cast<float>(table.T.front()));
    spec.attribute("celadon:maxT", static_cast<float>(table.T.back()));
    spec.attribute("celadon:epsilon", static_cast<float>(table.epsilon));
    spec.attribute("celadon:energy", static_cast<float>(table.energy));
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    if (!output || !output->open(target.temporaryPath().string(), spec) ||
        !output->write_image(OIIO::TypeFloat, row.data()) || !output->close()) {
        throw OutputError(fmt::format("'{}'", file.string()),
                          "cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
    }
    target.commit();
}

TableFile readTable(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
        throw InputError(fmt::format("'{}'", file.string()), "no such file");
    }
    if (fs::file_size(file, ignored) > kLargestFile) {
        refuse(fmt::format("'{}'", file.string()), "is over 16 MB");
    }
    if (file.extension() == ".exr") {
        return readTableExr(file);
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    return parseTableCsv(text, file.string());
}

RangeTable readRangeTable(const fs::path& file) {
    const TableFile table = readTable(file);
    return RangeTable::fromSamples(table.T, table.minimalRadius);
}

} // namespace celadon::subedit
