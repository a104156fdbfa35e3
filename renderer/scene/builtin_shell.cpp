// builtin:shell, after the precious wentletrap (Epitonium scalare): a tube that winds down a
// logarithmic spiral without touching itself, with fourteen thin blades a turn, hollow behind its
// mouth. About 100 mm high; blades of half a millimeter beside a solid spire.
//
// Every turn is the one before it scaled by kExpansion (Raup 1966, "Geometric analysis of shell
// coiling"): lengths below are in units of the scale s(theta) = e^(k theta) unless they say mm.
#include "renderer/scene/builtin_shapes.h"
#include "renderer/scene/chart_packing.h"
#include "renderer/scene/surface_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace celadon {

namespace {

constexpr double kExpansion = 1.55;   ///< scale of a turn over that of the turn before
constexpr double kCoilRadius = 0.56;  ///< from the axis to the middle of the tube
constexpr double kCoilHeight = 2.0;   ///< from the apex down to the middle of the tube
constexpr double kTubeRadius = 0.325; ///< turns stay 0.01 apart, blades included
constexpr double kBladeHeight = 0.31; ///< of the tube's radius
constexpr int kBlades = 14;           ///< a turn
constexpr int kTurns = 6;
constexpr int kStationsPerBlade = 12;
constexpr double kHollowTurns = 1.3; ///< how far the cavity reaches behind the mouth
constexpr double kWall = 0.10;       ///< of the tube's radius, at the mouth
constexpr double kHeightMm = 100.0;

constexpr double kTurn = glm::two_pi<double>();
const double kGrowth = std::log(kExpansion) / kTurn;

/// Theta is zero at the mouth and grows towards it: -kTurns turns at the apex.
constexpr double kApex = -kTurn * kTurns;
constexpr double kHollowFrom = -kTurn * kHollowTurns;

/// The mouth opens towards a viewer 30 degrees to the right of +z, as the default view has it.
constexpr double kMouthAzimuth = -glm::pi<double>() / 6.0;

/// Closes a tube like a quarter ellipse: 0 at `from`, 1 from `from + length` on.
double closing(double theta, double from, double length) {
    const double t = std::clamp((theta - from) / length, 0.0, 1.0);
    return std::sqrt(1.0 - (1.0 - t) * (1.0 - t));
}

class Shell {
public:
    Scene make() {
        layOutCharts();
        for (std::size_t i = 0; i < mBands.size(); ++i) {
            addBand(i);
        }
        addLip();
        return mSurface.finish("shell", mPacking.side);
    }

private:
    // ---- shape ----

    struct Frame {
        glm::dvec3 center, tangent, outward, binormal; ///< mm; tangent towards the mouth
    };

    [[nodiscard]] static double scaleMm(double theta) {
        return kHeightMm / (kCoilHeight + kTubeRadius) * std::exp(kGrowth * theta);
    }

    [[nodiscard]] static glm::dvec3 centerOf(double theta) {
        const double phi = theta + kMouthAzimuth;
        const double s = scaleMm(theta);
        return {s * kCoilRadius * std::cos(phi), 0.5 * kHeightMm - s * kCoilHeight,
                s * kCoilRadius * std::sin(phi)};
    }

    [[nodiscard]] static Frame frameOf(double theta) {
        const double phi = theta + kMouthAzimuth;
        Frame frame;
        frame.center = centerOf(theta);
        frame.tangent = glm::normalize(glm::dvec3(
            kCoilRadius * (kGrowth * std::cos(phi) - std::sin(phi)), -kGrowth * kCoilHeight,
            kCoilRadius * (kGrowth * std::sin(phi) + std::cos(phi))));
        const glm::dvec3 radial(std::cos(phi), 0.0, std::sin(phi));
        frame.outward = glm::normalize(radial - glm::dot(radial, frame.tangent) * frame.tangent);
        frame.binormal = glm::cross(frame.tangent, frame.outward);
        return frame;
    }

    /// Of the outside without its blades, mm.
    [[nodiscard]] static double tubeRadius(double theta) {
        const double flare = 1.0 + 0.22 * std::pow(glm::smoothstep(-0.40, 0.0, theta), 1.5);
        return kTubeRadius * scaleMm(theta) * closing(theta, kApex, 0.9) * flare;
    }

    /// Of the cavity, mm: thin walls at the mouth, thicker the further back.
    [[nodiscard]] static double cavityRadius(double theta) {
        const double back = glm::smoothstep(0.0, -0.75 * kHollowFrom, -theta);
        const double wall = kWall * (1.0 - 0.45 * glm::smoothstep(-0.30, 0.0, theta)) + 0.10 * back;
        return tubeRadius(theta) * (1.0 - wall) * closing(theta, kHollowFrom, 1.2);
    }

    /// The blades, in radii of the tube.
    [[nodiscard]] static double relief(double theta, double phi) {
        const double spacing = kTurn / kBlades;
        // The first blade stands half a spacing behind the mouth; higher on the shoulder of the
        // whorl, where real ones end in a small spine.
        const double x = theta / spacing + 0.5;
        const double distance = (x - std::round(x)) * spacing;
        const double shoulder = 0.82 + 0.18 * std::cos(phi - 0.8);
        const double thin = std::exp(-std::pow(distance / 0.032, 2.0));
        const double foot = std::exp(-std::pow(distance / 0.09, 2.0));
        const double blade = kBladeHeight * shoulder * (0.84 * thin + 0.16 * foot);
        return blade * glm::smoothstep(kApex, kApex + kTurn, theta) *
               (1.0 - glm::smoothstep(-0.20, -0.05, theta));
    }

    [[nodiscard]] static glm::dvec3 onTube(const Frame& frame, double radius, double phi) {
        return frame.center +
               radius * (std::cos(phi) * frame.outward + std::sin(phi) * frame.binormal);
    }

    // ---- patches: one band a turn, with its own chart ----

    struct Band {
        bool inside;
        int around;       ///< segments around the tube
        int aroundBefore; ///< of the band behind it: the same, half, or 0 where the tube closes
        std::vector<double> stations;
        std::vector<double> along;  ///< mm on the chart, at each station
        std::vector<double> radius; ///< mm, at each station
    };

    /// Angle around the tube; the seam, at -pi, is on the side of the axis.
    [[nodiscard]] static double phiOf(int j, int around) {
        return kTurn * (j % around) / around - glm::pi<double>();
    }

    /// Stations from blade to blade, dense on the blades.
    [[nodiscard]] static std::vector<double> stationsBetween(int firstBlade, int lastBlade,
                                                             bool even) {
        std::vector<double> stations;
        const double spacing = kTurn / kBlades;
        for (int blade = firstBlade; blade < lastBlade; ++blade) {
            const int count = even ? kStationsPerBlade / 2 : kStationsPerBlade;
            for (int i = 0; i < count; ++i) {
                const double x = static_cast<double>(i) / count;
                const double pulled = even ? x : x + 0.72 * std::sin(kTurn * x) / kTurn;
                stations.push_back(spacing * (blade + pulled));
            }
        }
        stations.push_back(spacing * lastBlade);
        return stations;
    }

    /// Stations that crowd towards the pole, where a tube closes like an ellipse.
    static void roundTheEnd(std::vector<double>& stations) {
        constexpr std::size_t kReplaced = 4;
        constexpr int kInstead = 12;
        const double from = stations[0];
        const double to = stations[kReplaced];
        std::vector<double> end;
        for (int i = 0; i < kInstead; ++i) {
            const double x = static_cast<double>(i) / kInstead;
            end.push_back(from + (to - from) * x * x);
        }
        stations.erase(stations.begin(), stations.begin() + kReplaced);
        stations.insert(stations.begin(), end.begin(), end.end());
    }

    void addBandOf(bool inside, int around, int aroundBefore, std::vector<double> stations) {
        Band band{inside, around, aroundBefore, std::move(stations), {}, {}};
        if (aroundBefore == 0) {
            roundTheEnd(band.stations);
        }
        // The chart's length is that of the surface's own way over the blades, on its outer side.
        double heightBefore = 0.0;
        glm::dvec3 centerBefore(0.0);
        for (const double theta : band.stations) {
            const double radius = inside ? cavityRadius(theta) : tubeRadius(theta);
            const double height = inside ? radius : radius * (1.0 + relief(theta, 0.0));
            const glm::dvec3 center = centerOf(theta);
            band.along.push_back(
                band.along.empty()
                    ? 0.0
                    : band.along.back() +
                          std::hypot(glm::distance(center, centerBefore), height - heightBefore));
            band.radius.push_back(radius);
            heightBefore = height;
            centerBefore = center;
        }
        mBands.push_back(std::move(band));
    }

    void layOutCharts() {
        // From the apex down, finer as the tube gets wider.
        constexpr std::array<int, kTurns> kAround{24, 24, 48, 48, 96, 96};
        for (int turn = 0; turn < kTurns; ++turn) {
            const auto t = static_cast<std::size_t>(turn);
            addBandOf(
                false, kAround[t], turn == 0 ? 0 : kAround[t - 1],
                stationsBetween((turn - kTurns) * kBlades, (turn - kTurns + 1) * kBlades, false));
        }
        std::vector<double> cavity =
            stationsBetween(static_cast<int>(std::floor(-kHollowTurns * kBlades)), 0, true);
        std::erase_if(cavity, [](double theta) { return theta < kHollowFrom; });
        cavity.insert(cavity.begin(), kHollowFrom);
        addBandOf(true, kAround.back(), 0, std::move(cavity));

        std::vector<glm::dvec2> sizes;
        for (const Band& band : mBands) {
            const double widest = *std::max_element(band.radius.begin(), band.radius.end());
            sizes.emplace_back(band.along.back() + kLipInChart, kTurn * widest);
        }
        mPacking = packCharts(sizes, 2.0);
        for (std::size_t i = 0; i < mBands.size(); ++i) {
            mPacking.corners[i].y += 0.5 * sizes[i].y;
            if (mBands[i].inside) { // seen from within, the mouth is on the left
                mPacking.corners[i].x += sizes[i].x;
            }
        }
    }

    /// On the chart a turn is a strip as wide as the tube's girth. A tube that winds has more
    /// surface outside than towards the axis: heights follow the area, as on a torus.
    [[nodiscard]] glm::dvec2 chartPoint(std::size_t index, double along, double radius, int j,
                                        int around) const {
        const Band& band = mBands[index];
        const double phi = kTurn * j / around - glm::pi<double>();
        const double bend = kTubeRadius / kCoilRadius;
        const double y = radius * (phi + bend * std::sin(phi));
        return mPacking.corners[index] + glm::dvec2(band.inside ? -along : along, y);
    }

    [[nodiscard]] SurfacePoint bandPoint(std::size_t index, std::size_t station, int j,
                                         int around) const {
        const Band& band = mBands[index];
        const double theta = band.stations[station];
        const double phi = phiOf(j, around);
        const double radius = band.radius[station] * (band.inside ? 1.0 : 1.0 + relief(theta, phi));
        return {onTube(frameOf(theta), radius, phi),
                chartPoint(index, band.along[station], band.radius[station], j, around)};
    }

    void addBand(std::size_t index) {
        const Band& band = mBands[index];
        const bool closes = band.aroundBefore == 0;
        const bool halves = !closes && band.aroundBefore != band.around;
        const std::size_t first = closes || halves ? 1 : 0;
        const auto stations = static_cast<int>(band.stations.size() - first) - 1;
        mSurface.addGrid(stations, band.around, [&](int column, int row) {
            const int station = band.inside ? stations - column : column;
            return bandPoint(index, first + static_cast<std::size_t>(station), row, band.around);
        });
        if (closes) {
            addEnd(index);
        }
        if (halves) {
            std::vector<std::uint32_t> fine;
            std::vector<std::uint32_t> coarse;
            for (int j = 0; j <= band.around; ++j) {
                fine.push_back(mSurface.add(bandPoint(index, 1, j, band.around)));
                if (j % 2 == 0) {
                    coarse.push_back(mSurface.add(bandPoint(index, 0, j / 2, band.aroundBefore)));
                }
            }
            mSurface.addHalving(fine, coarse);
        }
    }

    /// The pole at the apex, or at the bottom of the cavity.
    void addEnd(std::size_t index) {
        const Band& band = mBands[index];
        const std::uint32_t pole =
            mSurface.add({centerOf(band.stations[0]), chartPoint(index, 0.0, 0.0, 0, band.around)});
        std::vector<std::uint32_t> ring;
        for (int j = 0; j <= band.around; ++j) {
            ring.push_back(mSurface.add(bandPoint(index, 1, j, band.around)));
        }
        for (std::size_t j = 0; j + 1 < ring.size(); ++j) {
            if (band.inside) {
                mSurface.addTriangle(pole, ring[j], ring[j + 1]);
            } else {
                mSurface.addTriangle(pole, ring[j + 1], ring[j]);
            }
        }
    }

    /// The rim of the mouth: half an ellipse from the outside over to the cavity.
    void addLip() {
        constexpr int kHalf = 4;
        const std::size_t outside = kTurns - 1;
        const std::size_t inside = kTurns;
        const int segments = mBands[outside].around;
        const double outer = mBands[outside].radius.back();
        const double inner = mBands[inside].radius.back();
        const Frame frame = frameOf(0.0);
        const auto point = [&](int j, int k, bool within) {
            const Band& band = mBands[within ? inside : outside];
            const double turn = 0.5 * glm::pi<double>() * k / kHalf;
            const double phi = phiOf(j, segments);
            const double radius = k == 0 ? outer * (1.0 + relief(0.0, phi))
                                  : k == 2 * kHalf
                                      ? inner
                                      : glm::mix(outer, inner, 0.5 * (1.0 - std::cos(turn)));
            const double ahead =
                k == 0 || k == 2 * kHalf ? 0.0 : 0.6 * (outer - inner) * std::sin(turn);
            const double past = kLipInChart * (within ? 2 * kHalf - k : k) / kHalf;
            return SurfacePoint{onTube(frame, radius, phi) + ahead * frame.tangent,
                                chartPoint(within ? inside : outside, band.along.back() + past,
                                           band.radius.back(), j, segments)};
        };
        mSurface.addGrid(kHalf, segments,
                         [&](int column, int row) { return point(row, column, false); });
        mSurface.addGrid(kHalf, segments,
                         [&](int column, int row) { return point(row, kHalf + column, true); });
    }

    static constexpr double kLipInChart = 0.8; ///< mm

    std::vector<Band> mBands; ///< six turns of the outside, then the cavity
    ChartPacking mPacking;    ///< middle of each band's end behind, once laid out
    SurfaceBuilder mSurface;
};

} // namespace

Scene makeShell() {
    return Shell().make();
}

} // namespace celadon
