#include "subedit/fit/measured_curve.h"

#include "subedit/errors.h"
#include "subedit/log_linear.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

namespace celadon::subedit {

namespace {

constexpr std::size_t kLargestFile = 64u << 20;
constexpr double kSmallestP = 1e-300;

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> splitRow(std::string_view row) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = row.find_first_of(",;\t");
        cells.push_back(trim(row.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return cells;
        }
        row.remove_prefix(comma + 1);
    }
}

std::optional<double> toNumber(std::string_view cell) {
    if (cell.starts_with('+')) {
        cell.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc::result_out_of_range) {
        // Too small and too large are reported alike.
        const bool isSmall =
            cell.find("e-") != std::string_view::npos || cell.find("E-") != std::string_view::npos;
        return isSmall ? 0.0 : std::numeric_limits<double>::infinity();
    }
    if (error != std::errc{} || end != cell.data() + cell.size()) {
        return std::nullopt;
    }
    return value;
}

class CsvReader {
public:
    explicit CsvReader(const std::string& name) : mName(name) {}

    void readRow(std::string_view row, int line) {
        const std::vector<std::string_view> cells = splitRow(row);
        if (mProfile.radiiMm.empty() && !mHasHeader && !toNumber(cells.front())) {
            mHasHeader = true;
            return;
        }
        if (cells.size() < 2 || cells.size() == 3) {
            refuse(line, fmt::format("has {} columns", cells.size()),
                   "rows are r_mm,R,G,B or r_mm,P");
        }
        const double r = number(cells, 0, line);
        if (!mProfile.radiiMm.empty() && r <= mProfile.radiiMm.back()) {
            refuse(line,
                   fmt::format("radius {} mm does not rise over {} mm before it", r,
                               mProfile.radiiMm.back()),
                   "sort the rows by radius, one each");
        }
        mProfile.radiiMm.push_back(r);
        if (cells.size() == 2) {
            const double value = number(cells, 1, line);
            mProfile.value.push_back({value, value, value});
        } else {
            mProfile.value.push_back(
                {number(cells, 1, line), number(cells, 2, line), number(cells, 3, line)});
        }
    }

    [[nodiscard]] MeasuredProfile finish() const {
        const auto above =
            std::ranges::count_if(mProfile.radiiMm, [](double r) { return r > 0.0; });
        if (above < 2) {
            throw InputError(fmt::format("'{}'", mName),
                             fmt::format("holds {} rows of numbers with r > 0", above),
                             "a profile needs two or more rows r_mm,R,G,B");
        }
        return mProfile;
    }

private:
    [[noreturn]] void refuse(int line, const std::string& reason,
                             const std::string& remedy = {}) const {
        throw InputError(fmt::format("'{}', line {}", mName, line), reason, remedy);
    }

    [[nodiscard]] double number(const std::vector<std::string_view>& cells, std::size_t column,
                                int line) const {
        const std::optional<double> value = toNumber(cells[column]);
        if (!value) {
            refuse(line, fmt::format("column {} holds '{}', which is no number", column + 1,
                                     cells[column]));
        }
        if (!std::isfinite(*value) || *value < 0.0) {
            refuse(line, fmt::format("column {} holds {}, not a finite number >= 0", column + 1,
                                     cells[column]));
        }
        return *value;
    }

    const std::string& mName;
    bool mHasHeader = false;
    MeasuredProfile mProfile;
};

/// One channel of samples.
class SampledCurve {
public:
    SampledCurve(const MeasuredProfile& profile, std::size_t channel, CurveCenter center) {
        for (std::size_t i = 0; i < profile.radiiMm.size(); ++i) {
            const double p = profile.value[i][channel];
            if (profile.radiiMm[i] == 0.0) {
                mAtZero = p;
                continue;
            }
            mRadius.push_back(profile.radiiMm[i]);
            mLogRp.push_back(std::log(std::max(p, kSmallestP) * profile.radiiMm[i]));
        }
        mSlope = centerSlope(center);
        const double first = mRadius.front();
        if (mAtZero) {
            // ln P linear from the value at 0.
            mInner = 2.0 * std::numbers::pi *
                     pieceEnergy(std::log(std::max(*mAtZero, kSmallestP)),
                                 mLogRp.front() - std::log(first), 0.0, first);
        } else {
            mInner = 2.0 * std::numbers::pi * std::exp(mLogRp.front()) * first / (mSlope + 2.0);
        }
        mWithin.push_back(mInner);
        for (std::size_t i = 0; i + 1 < mRadius.size(); ++i) {
            mWithin.push_back(mWithin.back() + pieceWithin(i, 1.0));
        }
    }

    [[nodiscard]] double reflectance(double r) const {
        const double first = mRadius.front();
        if (r < first) {
            const double atFirst = std::exp(mLogRp.front()) / first;
            if (mAtZero) {
                const double low = std::max(*mAtZero, kSmallestP);
                return low *
                       std::pow(std::max(atFirst, kSmallestP) / low, std::max(r, 0.0) / first);
            }
            if (r <= 0.0) {
                return mSlope < 0.0 ? std::numeric_limits<double>::infinity() : atFirst;
            }
            return atFirst * std::pow(r / first, mSlope);
        }
        if (r > mRadius.back()) {
            return 0.0;
        }
        const auto [i, t] = find(r);
        return std::exp(mLogRp[i] + (mLogRp[i + 1] - mLogRp[i]) * t) / r;
    }

    [[nodiscard]] double energyWithin(double r) const {
        const double first = mRadius.front();
        if (!(r > 0.0)) {
            return 0.0;
        }
        if (r < first) {
            if (mAtZero) {
                return 2.0 * std::numbers::pi *
                       pieceEnergy(std::log(std::max(*mAtZero, kSmallestP)),
                                   mLogRp.front() - std::log(first), 0.0, first, r / first);
            }
            return mInner * std::pow(r / first, mSlope + 2.0);
        }
        if (r >= mRadius.back()) {
            return mWithin.back();
        }
        const auto [i, t] = find(r);
        return mWithin[i] + pieceWithin(i, t);
    }

    [[nodiscard]] double total() const { return mWithin.back(); }

private:
    [[nodiscard]] double centerSlope(CurveCenter center) const {
        if (center == CurveCenter::Flat || mRadius.size() < 2) {
            return 0.0;
        }
        if (center == CurveCenter::Singular) {
            return -1.0;
        }
        const double slope =
            (mLogRp[1] - mLogRp[0]) / std::log(mRadius[1] / mRadius[0]) - 1.0; // of ln P in ln r
        return std::clamp(slope, -1.5, 0.0);
    }

    /// 2 pi integral of r P over the first t of piece i, where r P is an exponential of r.
    [[nodiscard]] double pieceWithin(std::size_t i, double t) const {
        const double z = (mLogRp[i + 1] - mLogRp[i]) * t;
        return 2.0 * std::numbers::pi * std::exp(mLogRp[i]) * (mRadius[i + 1] - mRadius[i]) * t *
               expMoment0(z);
    }

    [[nodiscard]] std::pair<std::size_t, double> find(double r) const {
        const auto above = std::ranges::upper_bound(mRadius, r);
        const auto i =
            std::min(static_cast<std::size_t>(above - mRadius.begin()) - 1, mRadius.size() - 2);
        return {i, (r - mRadius[i]) / (mRadius[i + 1] - mRadius[i])};
    }

    std::vector<double> mRadius; ///< > 0
    std::vector<double> mLogRp;  ///< ln(r P)
    std::vector<double> mWithin; ///< energy inside each radius
    std::optional<double> mAtZero;
    double mSlope = 0.0; ///< of ln P over ln r, inside the first radius, where P(0) is not given
    double mInner = 0.0; ///< energy there
};

} // namespace

MeasuredProfile parseProfileCsv(std::string_view text, const std::string& name) {
    CsvReader reader(name);
    int line = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view row = trim(text.substr(0, end));
        ++line;
        if (!row.empty() && !row.starts_with('#')) {
            reader.readRow(row, line);
        }
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return reader.finish();
}

MeasuredProfile readProfileCsv(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        throw InputError(fmt::format("'{}'", file.string()), "no such file");
    }
    if (std::filesystem::file_size(file, ignored) > kLargestFile) {
        throw InputError(fmt::format("'{}'", file.string()),
                         "is over 64 MB: no table of a profile");
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    if (!stream.good() && !stream.eof()) {
        throw InputError(fmt::format("'{}'", file.string()), "cannot be read");
    }
    return parseProfileCsv(text, file.string());
}

RadialCurves measuredCurves(const MeasuredProfile& profile, CurveCenter center) {
    RadialCurves curves;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto curve = std::make_shared<const SampledCurve>(profile, channel, center);
        curves[channel] = {[curve](double r) { return curve->reflectance(r); },
                           [curve](double r) { return curve->energyWithin(r); }, curve->total()};
    }
    return curves;
}

} // namespace celadon::subedit
