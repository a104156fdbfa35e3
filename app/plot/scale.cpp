#include "app/plot/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace celadon::plot {

namespace {

/// The largest of 1, 2, 5 times a power of ten that gives at least `least` steps.
double niceStep(double span, double least) {
    const double rough = span / least;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {5.0, 2.0, 1.0}) {
        if (factor * power <= rough * (1.0 + 1e-9)) {
            return factor * power;
        }
    }
    return power;
}

} // namespace

Scale::Scale(const Axis& axis, std::span<const double> values, double start, double end,
             bool isPadded)
    : mIsLogarithmic(axis.isLogarithmic), mStart(start), mEnd(end) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const double value : values) {
        if (std::isfinite(value) && (!mIsLogarithmic || value > 0.0)) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    if (!(least <= most)) { // nothing to show
        least = mIsLogarithmic ? 0.1 : 0.0;
        most = 1.0;
    }
    if (mIsLogarithmic) {
        if (isPadded) {
            least = std::pow(10.0, std::floor(std::log10(least) + 1e-9));
            most = std::pow(10.0, std::ceil(std::log10(most) - 1e-9));
        }
        if (most <= least * 1.0001) {
            most = least * 10.0;
        }
    } else {
        if (isPadded) {
            const double step = niceStep(std::max(most - least, 1e-300), 5.0);
            least = std::floor(least / step + 1e-9) * step;
            most = std::ceil(most / step - 1e-9) * step;
        }
        if (most <= least) {
            most = least + std::max(std::abs(least), 1.0);
        }
    }
    mFrom = axis.from.value_or(least);
    mTo = axis.to.value_or(most);
    if (!(mTo > mFrom)) {
        mTo = mIsLogarithmic ? mFrom * 10.0 : mFrom + 1.0;
    }
}

bool Scale::canShow(double value) const {
    return std::isfinite(value) && (!mIsLogarithmic || value > 0.0);
}

double Scale::place(double value) const {
    const double t = mIsLogarithmic ? std::log(value / mFrom) / std::log(mTo / mFrom)
                                    : (value - mFrom) / (mTo - mFrom);
    return mStart + (mEnd - mStart) * t;
}

void Scale::setEnds(double start, double end) {
    mStart = start;
    mEnd = end;
}

std::vector<Tick> Scale::ticks() const {
    return mIsLogarithmic ? logarithmicTicks() : linearTicks();
}

std::vector<Tick> Scale::linearTicks() const {
    const double step = niceStep(mTo - mFrom, 5.0);
    const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    const bool isWide = std::max(std::abs(mFrom), std::abs(mTo)) >= 1e6 || digits > 5;
    std::vector<Tick> ticks;
    const auto first = static_cast<long>(std::ceil(mFrom / step - 1e-9));
    const auto last = static_cast<long>(std::floor(mTo / step + 1e-9));
    for (long i = first; i <= last; ++i) {
        const double value = static_cast<double>(i) * step;
        ticks.push_back(
            {value, isWide ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, digits)});
    }
    return ticks;
}

std::vector<Tick> Scale::logarithmicTicks() const {
    const int first = static_cast<int>(std::floor(std::log10(mFrom) + 1e-9));
    const int last = static_cast<int>(std::ceil(std::log10(mTo) - 1e-9));
    const int every = std::max(1, (last - first + 8) / 9);
    const bool isNarrow = last - first <= 2;
    std::vector<Tick> ticks;
    for (int exponent = first; exponent <= last; ++exponent) {
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * std::pow(10.0, exponent);
            if (value < mFrom * (1.0 - 1e-9) || value > mTo * (1.0 + 1e-9)) {
                continue;
            }
            const bool isLabeled = digit == 1 && (exponent - first) % every == 0;
            if (isLabeled) {
                ticks.push_back({value, powerOfTen(exponent)});
            } else if (isNarrow && (digit == 2 || digit == 5)) {
                ticks.push_back({value, fmt::format("{:g}", value)});
            } else if (every == 1 || digit == 1) {
                ticks.push_back({value, ""});
            }
        }
    }
    return ticks;
}

std::string powerOfTen(int exponent) {
    if (exponent >= -2 && exponent <= 3) {
        return fmt::format("{:g}", std::pow(10.0, exponent));
    }
    constexpr std::string_view kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) {
        text += kDigits[digit - '0'];
    }
    return text;
}

} // namespace celadon::plot
