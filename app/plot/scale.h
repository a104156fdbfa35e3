#pragma once

#include "app/plot/chart.h"

#include <span>
#include <string>
#include <vector>

/// From values to places on an axis, and where its ticks are.
namespace celadon::plot {

struct Tick {
    double value;
    std::string label; ///< empty for minor ticks
};

class Scale {
public:
    /// @param values    what the axis shows; those that it cannot show are left out
    /// @param start,end places of the two ends
    /// @param isPadded  leaves some room at ends that follow the data
    Scale(const Axis& axis, std::span<const double> values, double start, double end,
          bool isPadded);

    [[nodiscard]] bool canShow(double value) const;
    [[nodiscard]] double place(double value) const;
    [[nodiscard]] double from() const { return mFrom; }
    [[nodiscard]] double to() const { return mTo; }
    [[nodiscard]] double start() const { return mStart; }
    [[nodiscard]] double end() const { return mEnd; }
    void setEnds(double start, double end);
    [[nodiscard]] std::vector<Tick> ticks() const;

private:
    [[nodiscard]] std::vector<Tick> linearTicks() const;
    [[nodiscard]] std::vector<Tick> logarithmicTicks() const;

    bool mIsLogarithmic;
    double mFrom, mTo;
    double mStart, mEnd;
};

/// "10⁻³" or "0.01": powers of ten as they are read best.
[[nodiscard]] std::string powerOfTen(int exponent);

} // namespace celadon::plot
