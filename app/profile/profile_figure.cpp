#include "app/profile/profile_figure.h"

#include "app/plot/chart.h"
#include "subedit/medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace celadon::app {

namespace {

using namespace plot;

constexpr int kPoints = 400;
constexpr double kDecadesShown = 8.0; ///< of P, below its largest value drawn

std::vector<double> sampleRadii(double from, double to, bool isLog) {
    std::vector<double> radii;
    for (int i = 0; i <= kPoints; ++i) {
        const double t = static_cast<double>(i) / kPoints;
        radii.push_back(isLog ? from * std::pow(to / from, t) : from + (to - from) * t);
    }
    return radii;
}

/// How one channel of one profile is drawn: by channel where there is one profile, else by profile,
/// the channels told apart by their dashes.
struct Look {
    Color color;
    std::vector<double> dash;
    std::string label;
};

Look lookOf(const std::vector<NamedProfile>& profiles, std::size_t profile, int channel,
            int channelCount) {
    static const std::vector<double> kDashes[] = {{}, {7.0, 3.0}, {2.0, 2.5}};
    if (profiles.size() == 1) {
        return {channelColor(channel), {}, subedit::channelName(channel)};
    }
    const std::string label = channelCount == 1 ? profiles[profile].name
                                                : fmt::format("{}, {}", profiles[profile].name,
                                                              subedit::channelName(channel));
    return {seriesColor(profile), channelCount == 1 ? std::vector<double>{} : kDashes[channel],
            label};
}

class Figure {
public:
    Figure(const std::vector<NamedProfile>& profiles, const FigureSettings& settings)
        : mProfiles(profiles), mSettings(settings) {
        double reach = 0.0;
        for (const NamedProfile& profile : profiles) {
            reach = std::max(reach, profile.maxRadiusMm);
        }
        mTo = settings.toRadiusMm.value_or(reach > 0.0 ? reach : 1.0);
        mFrom = settings.fromRadiusMm.value_or(settings.isLogRadius ? mTo / 1000.0 : 0.0);
        mFrom = std::min(mFrom, 0.99 * mTo);
        mRadii = sampleRadii(mFrom, mTo, settings.isLogRadius);
    }

    [[nodiscard]] Drawing draw() const {
        std::vector<Drawing> panels{drawReflectance()};
        if (mSettings.showsRatio && mProfiles.size() > 1) {
            panels.push_back(drawRatio());
        }
        if (mSettings.showsEnergy) {
            panels.push_back(drawEnergy());
        }
        return placeBeside(panels);
    }

private:
    [[nodiscard]] Axis radiusAxis() const { return {"r [mm]", mSettings.isLogRadius, mFrom, mTo}; }

    template<typename Visit>
    void forEachCurve(const Visit& visit) const {
        const auto count = static_cast<int>(std::ranges::count(mSettings.channels, true));
        for (std::size_t p = 0; p < mProfiles.size(); ++p) {
            for (int channel = 0; channel < 3; ++channel) {
                const auto c = static_cast<std::size_t>(channel);
                if (mSettings.channels[c]) {
                    visit(mProfiles[p], mProfiles[p].curves[c], c,
                          lookOf(mProfiles, p, channel, count));
                }
            }
        }
    }

    [[nodiscard]] Drawing drawReflectance() const {
        LineChart chart{mSettings.title.empty() ? "Scattering profile" : mSettings.title,
                        radiusAxis(),
                        {"P(r) [1/mm²]", true},
                        {}};
        double largest = 0.0;
        double smallest = 1e300;
        forEachCurve([&](const NamedProfile& profile, const subedit::RadialCurve& curve,
                         std::size_t c, const Look& look) {
            Series series{look.label, {}, look.color, 1.8, look.dash};
            for (const double r : mRadii) {
                const double value = r <= profile.maxRadiusMm ? curve.reflectance(r) : 0.0;
                series.points.emplace_back(r, value);
                if (std::isfinite(value) && value > 0.0) {
                    largest = std::max(largest, value);
                    smallest = std::min(smallest, value);
                }
            }
            chart.series.push_back(series);
            if (!profile.samples[c].empty()) {
                Series bars{"", {}, look.color};
                bars.hasLine = false;
                for (const auto& [r, value, error] : profile.samples[c]) {
                    bars.points.emplace_back(r, value);
                    bars.error.push_back(error);
                }
                chart.series.push_back(bars);
            }
        });
        if (largest > 0.0) {
            const double top = std::pow(10.0, std::ceil(std::log10(largest) - 1e-9));
            const double bottom = std::pow(10.0, std::floor(std::log10(smallest) + 1e-9));
            chart.y.to = top;
            chart.y.from = std::max(bottom, top * std::pow(10.0, -kDecadesShown));
        }
        addRadiusMarkers(chart);
        return drawChart(chart);
    }

    /// R_P of each curve, where there are few enough to read.
    void addRadiusMarkers(LineChart& chart) const {
        const auto curves = mProfiles.size() *
                            static_cast<std::size_t>(std::ranges::count(mSettings.channels, true));
        if (curves > 4) {
            return;
        }
        forEachCurve([&](const NamedProfile&, const subedit::RadialCurve& curve, std::size_t,
                         const Look& look) {
            const double radius = subedit::radiusHolding(curve, mSettings.energy);
            if (curve.total > 1e-6 && radius <= mTo) {
                chart.markers.push_back({radius, fmt::format("Rₚ {:.3g} mm", radius), look.color});
            }
        });
    }

    [[nodiscard]] Drawing drawEnergy() const {
        LineChart chart{
            "Energy within r", radiusAxis(), {"fraction of the albedo", false, 0.0, 1.0}, {}};
        chart.legend = Legend::BottomRight;
        forEachCurve([&](const NamedProfile&, const subedit::RadialCurve& curve, std::size_t,
                         const Look& look) {
            if (curve.total <= 1e-6) {
                return;
            }
            const double radius = subedit::radiusHolding(curve, mSettings.energy);
            Series series{
                fmt::format("{}: A = {:.3f}, Rₚ = {:.3g} mm", look.label, curve.total, radius),
                {},
                look.color,
                1.8,
                look.dash};
            for (const double r : mRadii) {
                series.points.emplace_back(r, curve.energyWithin(r) / curve.total);
            }
            chart.series.push_back(series);
            Series dot{"", {{radius, mSettings.energy}}, look.color};
            dot.hasDots = true;
            chart.series.push_back(dot);
        });
        chart.markers.push_back({mSettings.energy, fmt::format("{:g} %", 100.0 * mSettings.energy),
                                 Color(0.35f), true});
        return drawChart(chart);
    }

    [[nodiscard]] Drawing drawRatio() const {
        LineChart chart{fmt::format("Relative to {}", mProfiles.front().name),
                        radiusAxis(),
                        {fmt::format("P(r) / P(r) of {}", mProfiles.front().name), true, 0.1, 10.0},
                        {}};
        chart.legend = Legend::None;
        forEachCurve([&](const NamedProfile& profile, const subedit::RadialCurve& curve,
                         std::size_t c, const Look& look) {
            const subedit::RadialCurve& first = mProfiles.front().curves[c];
            Series series{look.label, {}, look.color, 1.8, look.dash};
            for (const double r : mRadii) {
                const bool isInside =
                    r <= profile.maxRadiusMm && r <= mProfiles.front().maxRadiusMm;
                series.points.emplace_back(r, isInside ? curve.reflectance(r) / first.reflectance(r)
                                                       : 0.0);
            }
            chart.series.push_back(series);
        });
        return drawChart(chart);
    }

    const std::vector<NamedProfile>& mProfiles;
    const FigureSettings& mSettings;
    double mFrom = 0.0;
    double mTo = 1.0;
    std::vector<double> mRadii;
};

} // namespace

Drawing drawProfiles(const std::vector<NamedProfile>& profiles, const FigureSettings& settings) {
    return Figure(profiles, settings).draw();
}

} // namespace celadon::app
