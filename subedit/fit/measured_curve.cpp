#include "subedit/fit/measured_curve.h"

#include "subedit/errors.h"
#include "subedit/log_linear.h"
#include "subedit/models/gauss_legendre.h"

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
constexpr double kLargestNumber = 1e17; ///< ln P of a stored profile ends at 40
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
                                     printable(cells[column])));
        }
        if (!std::isfinite(*value) || *value < 0.0) {
            refuse(line, fmt::format("column {} holds {}, not a finite number >= 0", column + 1,
                                     cells[column]));
        }
        if (*value > kLargestNumber) {
            refuse(line, fmt::format("column {} holds {}: no radius in mm and no profile in 1/mm^2 "
                                     "is above {:g}",
                                     column + 1, cells[column], kLargestNumber));
        }
        return *value;
    }

    /// What a terminal shows of any bytes, and not too much of it.
    static std::string printable(std::string_view text) {
        constexpr std::size_t kMost = 40;
        std::string shown(text.substr(0, kMost));
        std::ranges::replace_if(
            shown, [](char c) { return c < ' ' || c > '~'; }, '?');
        return text.size() > kMost ? shown + "..." : shown;
    }

    const std::string& mName;
    bool mHasHeader = false;
    MeasuredProfile mProfile;
};

/// What lies inside the first sample at r > 0: r P = e^a r^c e^(-b r).
class CurveCore {
public:
    CurveCore() = default;
    /// @param logRp ln(r P) at the samples
    CurveCore(const std::vector<double>& radius, const std::vector<double>& logRp,
              CurveCenter center)
        : mRadius(radius.front()), mLogRp(logRp.front()) {
        if (center == CurveCenter::Flat) {
            mPower = 1.0;
        } else if (center == CurveCenter::Auto) {
            fit(radius, logRp);
        }
    }

    [[nodiscard]] double reflectance(double r) const {
        if (r <= 0.0 && mPower < kFlat) {
            return std::numeric_limits<double>::infinity();
        }
        const double x = std::max(r / mRadius, 1e-9);
        return std::exp(mLogRp + (mPower - 1.0) * std::log(x) + mDecay * (1.0 - x)) / mRadius;
    }

    /// By quadrature in x = s^4, which is smooth for all powers.
    [[nodiscard]] double energyWithin(double r) const {
        static const std::vector<QuadratureNode> nodes = [] {
            std::vector<QuadratureNode> made;
            appendGaussLegendre(made, 0.0, 1.0, 16);
            return made;
        }();
        const double end = std::max(r, 0.0) / mRadius;
        double sum = 0.0;
        for (const QuadratureNode& node : nodes) {
            const double s = node.position;
            const double x = end * s * s * s * s;
            sum += node.weight * 4.0 * s * s * s * end *
                   std::exp(mLogRp + mPower * std::log(x) + mDecay * (1.0 - x));
        }
        return 2.0 * std::numbers::pi * mRadius * sum;
    }

private:
    static constexpr double kFlat = 0.95;
    static constexpr double kSteepest = -0.2;
    static constexpr double kMostDecay = 1.5; ///< over the first radius

    void fit(const std::vector<double>& radius, const std::vector<double>& logRp) {
        const double x = std::log(radius[1] / radius[0]);
        const double dx = (radius[1] - radius[0]) / radius[0];
        const double y = logRp[1] - logRp[0];
        if (radius.size() > 2) {
            // y = c x - b dx at the second sample and at the third.
            const double x2 = std::log(radius[2] / radius[0]);
            const double dx2 = (radius[2] - radius[0]) / radius[0];
            const double y2 = logRp[2] - logRp[0];
            mPower = (y * dx2 - y2 * dx) / (x * dx2 - x2 * dx);
        } else {
            mPower = y / x;
        }
        mPower = std::clamp(mPower, kSteepest, 1.0);
        mDecay = std::clamp((mPower * x - y) / dx, -kMostDecay, kMostDecay);
    }

    double mRadius = 1.0; ///< of the first sample
    double mLogRp = 0.0;  ///< there
    double mPower = 0.0;  ///< c
    double mDecay = 0.0;  ///< b times the first radius
};

/// One channel of samples.
class SampledCurve {
public:
    SampledCurve(const MeasuredProfile& profile, std::size_t channel, CurveCenter center) {
        for (std::size_t i = 0; i < profile.radiiMm.size(); ++i) {
            const double p = profile.value[i][channel];
            if (profile.radiiMm[i] == 0.0) {
                mLogAtZero = std::log(std::max(p, kSmallestP));
                continue;
            }
            mRadius.push_back(profile.radiiMm[i]);
            mLogRp.push_back(std::log(std::max(p, kSmallestP) * profile.radiiMm[i]));
        }
        mCore = CurveCore(mRadius, mLogRp, center);
        mWithin.push_back(innerEnergy(mRadius.front()));
        for (std::size_t i = 0; i + 1 < mRadius.size(); ++i) {
            mWithin.push_back(mWithin.back() + pieceWithin(i, 1.0));
        }
    }

    [[nodiscard]] double reflectance(double r) const {
        const double first = mRadius.front();
        if (r < first) {
            return mLogAtZero ? std::exp(std::lerp(*mLogAtZero, mLogRp.front() - std::log(first),
                                                   std::max(r, 0.0) / first))
                              : mCore.reflectance(r);
        }
        if (r > mRadius.back()) {
            return 0.0;
        }
        const auto [i, t] = find(r);
        return mLogAtZero ? std::exp(std::lerp(logP(i), logP(i + 1), t))
                          : std::exp(std::lerp(mLogRp[i], mLogRp[i + 1], t)) / r;
    }

    [[nodiscard]] double energyWithin(double r) const {
        if (!(r > 0.0)) {
            return 0.0;
        }
        if (r < mRadius.front()) {
            return innerEnergy(r);
        }
        if (r >= mRadius.back()) {
            return mWithin.back();
        }
        const auto [i, t] = find(r);
        return mWithin[i] + pieceWithin(i, t);
    }

    [[nodiscard]] double total() const { return mWithin.back(); }

private:
    /// Up to the first radius > 0. From a sample at 0, ln P is linear.
    [[nodiscard]] double innerEnergy(double r) const {
        if (!mLogAtZero) {
            return mCore.energyWithin(r);
        }
        const double first = mRadius.front();
        return 2.0 * std::numbers::pi *
               pieceEnergy(*mLogAtZero, mLogRp.front() - std::log(first), 0.0, first, r / first);
    }

    [[nodiscard]] double logP(std::size_t i) const { return mLogRp[i] - std::log(mRadius[i]); }

    /// 2 pi integral of r P over the first t of piece i, where P, or r P, is an exponential of r.
    [[nodiscard]] double pieceWithin(std::size_t i, double t) const {
        if (mLogAtZero) {
            return 2.0 * std::numbers::pi *
                   pieceEnergy(logP(i), logP(i + 1), mRadius[i], mRadius[i + 1] - mRadius[i], t);
        }
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
    std::optional<double> mLogAtZero;
    CurveCore mCore; ///< used where P(0) is not given
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
