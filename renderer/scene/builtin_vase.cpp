// builtin:vase, after the openwork incense burners of Goryeo celadon: a jar whose belly is pierced
// in the pattern of linked circles, with carved lotus petals below, lappets above, bosses where the
// circles meet, and a thin flaring lip. Walls of 1.5 to 6 mm, 102 mm high.
//
// The wall is one parametric patch: u around the axis, v along the outer profile from the foot to
// the lip, w through the wall from outside (0) to inside (1). The openwork is made of diamonds that
// touch along their edges; each is a ring of quads between its border and the hole, whose rim is a
// half ellipse through the wall. What is left between the holes are the leaves of the circles.
#include "renderer/scene/builtin_shapes.h"
#include "renderer/scene/profile_curve.h"
#include "renderer/scene/surface_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace celadon {

namespace {

constexpr int kTiles = 18;        ///< diamonds around
constexpr int kDiamondRows = 5;   ///< each half a diamond above the one before; odd
constexpr int kTileSegments = 14; ///< per edge of a diamond, and along its width
constexpr int kAround = kTiles * kTileSegments;
static_assert(kTileSegments % 2 == 0, "diamonds in odd rows stand half a width to the side");
constexpr double kStation = 0.8; ///< mm between rows of vertices on the outside
constexpr double kChartMargin = 4.0;

double bump(double distance, double width) {
    return std::exp(-(distance * distance) / (width * width));
}

/// A carved petal with its tip at y = 1, its base at y = 0; x from its middle line. All in mm but
/// y.
/// @return height above the ground, 0 outside
double petalHeight(double x, double y, double halfWidth, double height) {
    if (y >= 1.0) {
        return 0.0;
    }
    const double along = std::max(y, 0.0);
    // An ogee arch: full at the base, drawn in to a point.
    const double width = halfWidth * std::pow(1.0 - std::pow(along, 2.6), 0.8);
    const double inside = width - std::abs(x);
    if (inside <= 0.0) {
        return 0.0;
    }
    const double across = std::abs(x) / width;
    const double step = glm::smoothstep(0.0, 2.0, inside);
    const double hollow = 0.55 + 0.45 * along - 0.35 * (1.0 - across * across) * (1.0 - along);
    const double border = 0.34 * bump(inside - 1.7, 0.9);
    const double vein = 0.25 * bump(x, 0.8) * (1.0 - along);
    return height * step * (hollow + border + vein);
}

class Vase {
public:
    Vase()
        : mOuter({{17.6, 0.0},
                  {19.2, 0.7},
                  {19.8, 2.5},
                  {19.0, 5.2},
                  {19.0, 8.5},
                  {22.0, 17.5},
                  {27.6, 30.5},
                  {33.4, 44.0},
                  {36.6, 57.5},
                  {34.9, 69.0},
                  {28.4, 77.8},
                  {20.6, 83.4},
                  {15.8, 88.0},
                  {14.6, 92.2},
                  {16.0, 96.4},
                  {19.2, 99.9},
                  {22.8, 101.8}}),
          mUnderside(
              {{17.6, 0.0}, {16.4, 0.5}, {15.8, 2.0}, {14.4, 3.6}, {11.0, 4.2}, {0.0, 4.4}}) {
        mDiamondHeight = 0.98 * glm::two_pi<double>() * 36.0 / kTiles;
        const double height = 0.5 * (kDiamondRows + 1) * mDiamondHeight;
        mPiercedFrom = mOuter.atHeight(55.5) - 0.5 * height;
        mPiercedTo = mPiercedFrom + height;
        mShoulderTo = mOuter.atHeight(86.5);
        mFootTo = mOuter.atHeight(8.0);
        mInnerFrom = mOuter.atHeight(15.0);
        const glm::dvec2 start = innerProfile(mInnerFrom);
        const glm::dvec2 down = -mOuter.tangent(mInnerFrom);
        mBowl = ProfileCurve({start,
                              start + 3.0 * down,
                              start + 5.6 * down + glm::dvec2(-1.6, 0.4),
                              {9.0, 8.9},
                              {0.0, 8.6}});
        layOutCharts();
    }

    [[nodiscard]] Scene make() {
        addOutside();
        addInside();
        addOpenwork();
        addLip();
        addDisc(mUnderside, mUndersideCenter, kAround, false);
        addDisc(mBowl, mBowlCenter, kAround / 2, true);
        return mSurface.finish("vase", mChartSide);
    }

private:
    // ---- shape ----

    [[nodiscard]] double thickness(double v) const {
        const double t = v / mOuter.length();
        const double foot = 2.6 * (1.0 - glm::smoothstep(0.0, 0.4, t));
        const double lip = 1.6 * glm::smoothstep(0.72, 1.0, t);
        return 3.1 + foot - lip;
    }

    [[nodiscard]] glm::dvec2 outward(double v) const {
        const glm::dvec2 t = mOuter.tangent(v);
        return {t.y, -t.x};
    }

    [[nodiscard]] glm::dvec2 innerProfile(double v) const {
        return mOuter.at(v) - thickness(v) * outward(v);
    }

    [[nodiscard]] double relief(double u, double v) const {
        const double tile = u / kTileSegments; // in tiles
        const double radius = mOuter.at(v).x;
        const double tileWidth = glm::two_pi<double>() * radius / kTiles;
        const auto fromMiddle = [](double x) { return x - std::floor(x) - 0.5; };
        double height = 0.0;

        // Two rows of petals below, each two tiles wide, the back row between those of the front.
        const double below = mPiercedFrom - 1.5;
        if (v > mFootTo - 2.0 && v < below) {
            const double rise = glm::smoothstep(mFootTo - 2.0, mFootTo + 2.0, v);
            const double y = (v - mFootTo) / (below - mFootTo);
            const double front = fromMiddle(0.5 * tile) * 2.0 * tileWidth;
            const double back = fromMiddle(0.5 * tile + 0.5) * 2.0 * tileWidth;
            height = rise * std::max(petalHeight(front, y / 0.8, 0.98 * tileWidth, 1.9),
                                     petalHeight(back, y, 0.98 * tileWidth, 1.1));
        }
        // One row of lappets on the shoulder, tips down.
        const double above = mPiercedTo + 1.5;
        if (v > above && v < mShoulderTo + 1.0) {
            const double fall = 1.0 - glm::smoothstep(mShoulderTo - 1.0, mShoulderTo + 1.0, v);
            const double y = (mShoulderTo - v) / (mShoulderTo - above);
            const double front = fromMiddle(tile) * tileWidth;
            const double back = fromMiddle(tile + 0.5) * tileWidth;
            height = fall * std::max(petalHeight(front, y / 0.82, 0.47 * tileWidth, 1.2),
                                     petalHeight(back, y, 0.47 * tileWidth, 0.7));
        }
        // Bands that frame the openwork, a ring at the neck, a ring on the foot.
        height +=
            1.1 * bump(v - (mPiercedFrom - 0.4), 1.0) + 1.1 * bump(v - (mPiercedTo + 0.4), 1.0);
        height += 0.9 * bump(v - (mShoulderTo + 2.2), 1.1);
        // Ridges along the leaves, and a boss at every meeting of circles: both on the lattice of
        // the diamonds' edges, along which p or q is a whole number.
        if (v > mPiercedFrom - 4.0 && v < mPiercedTo + 4.0) {
            const double up = (v - mPiercedFrom) / mDiamondHeight;
            const double p = tile + up - 0.5 - std::round(tile + up - 0.5);
            const double q = tile - up - 0.5 - std::round(tile - up - 0.5);
            const double du = 0.5 * (p + q) * tileWidth;
            const double dv = 0.5 * (p - q) * mDiamondHeight;
            const double across =
                tileWidth * mDiamondHeight / std::hypot(tileWidth, mDiamondHeight);
            const double inBand = glm::smoothstep(mPiercedFrom - 0.2, mPiercedFrom + 1.0, v) *
                                  (1.0 - glm::smoothstep(mPiercedTo - 1.0, mPiercedTo + 0.2, v));
            height += inBand * 0.45 * bump(across * std::min(std::abs(p), std::abs(q)), 1.0);
            height += 1.0 * (1.0 - glm::smoothstep(0.2, 2.1, std::hypot(du, dv)));
        }
        return height;
    }

    /// Sideways sway of the whole wall: the mouth opens like a mallow flower, in nine lobes.
    [[nodiscard]] double foliation(double u, double v) const {
        const double rise = glm::smoothstep(0.86 * mOuter.length(), mOuter.length(), v);
        return 0.9 * rise * std::cos(9.0 * glm::two_pi<double>() * std::fmod(u, kAround) / kAround);
    }

    /// @param u in segments, 0 and kAround being the same; @param w 0 outside to 1 inside
    [[nodiscard]] glm::dvec3 wall(double u, double v, double w) const {
        const glm::dvec2 p =
            mOuter.at(v) +
            (foliation(u, v) + (1.0 - w) * relief(u, v) - w * thickness(v)) * outward(v);
        return turned(p, u);
    }

    [[nodiscard]] static glm::dvec3 turned(const glm::dvec2& profile, double u) {
        if (u >= kAround) {
            u -= kAround;
        }
        const double phi = glm::two_pi<double>() * u / kAround + glm::pi<double>(); // seam at -z
        return {profile.x * std::sin(phi), profile.y, profile.x * std::cos(phi)};
    }

    // ---- texture: outside, inside and two discs below each other, all at one scale ----

    void layOutCharts() {
        mChartWidth = glm::two_pi<double>() * 30.0;
        const double outside = mOuter.length();
        const double inside = mOuter.length() - mInnerFrom;
        const double discs = 2.0 * std::max(mUnderside.length(), mBowl.length());
        mOutsideTop = kChartMargin;
        mInsideTop = mOutsideTop + outside + kChartMargin;
        const double discsTop = mInsideTop + inside + kChartMargin;
        mBowlCenter = {kChartMargin + mBowl.length(), discsTop + 0.5 * discs};
        mUndersideCenter = {mBowlCenter.x + mBowl.length() + kChartMargin + mUnderside.length(),
                            mBowlCenter.y};
        mChartSide =
            std::max(discsTop + discs, mChartWidth * (kTiles + 1) / kTiles + kChartMargin) +
            kChartMargin;
    }

    [[nodiscard]] glm::dvec2 outsideChart(double u, double v) const {
        return {kChartMargin + mChartWidth * u / kAround, mOutsideTop + mOuter.length() - v};
    }

    /// Turned by half a turn against the outside, so that it is not a mirror image.
    [[nodiscard]] glm::dvec2 insideChart(double u, double v) const {
        return {kChartMargin +
                    mChartWidth * (static_cast<double>(kTiles + 1) / kTiles - u / kAround),
                mInsideTop + mOuter.length() - v};
    }

    [[nodiscard]] SurfacePoint outsidePoint(double u, double v) const {
        return {wall(u, v, 0.0), outsideChart(u, v)};
    }

    [[nodiscard]] SurfacePoint insidePoint(double u, double v) const {
        return {wall(u, v, 1.0), insideChart(u, v)};
    }

    // ---- patches ----

    static std::vector<double> stations(double from, double to, double spacing) {
        const int count = std::max(1, static_cast<int>(std::lround((to - from) / spacing)));
        std::vector<double> v;
        for (int i = 0; i < count; ++i) {
            v.push_back(from + (to - from) * i / count);
        }
        v.push_back(to);
        return v;
    }

    void addWall(const std::vector<double>& v, int columns, bool inside) {
        const int rows = static_cast<int>(v.size()) - 1;
        const int step = kAround / columns;
        mSurface.addGrid(columns, rows, [&](int column, int row) {
            // Down the page: from high v to low outside; inside u runs the other way.
            const double station = v[static_cast<std::size_t>(rows - row)];
            return inside ? insidePoint((columns - column) * step, station)
                          : outsidePoint(column * step, station);
        });
    }

    void addOutside() {
        addWall(stations(0.0, mPiercedFrom, kStation), kAround, false);
        addWall(stations(mPiercedTo, mOuter.length(), kStation), kAround, false);
    }

    /// Smooth, so half as fine; one row of triangles leads over to the pierced tiles and the lip.
    void addInside() {
        const double step = 2.0 * kStation;
        addWall(stations(mInnerFrom, mPiercedFrom - step, step), kAround / 2, true);
        addInsideTransition(mPiercedFrom, mPiercedFrom - step);
        addInsideTransition(mPiercedTo, mPiercedTo + step);
        addWall(stations(mPiercedTo + step, mOuter.length() - step, step), kAround / 2, true);
        addInsideTransition(mOuter.length(), mOuter.length() - step);
    }

    void addInsideTransition(double fine, double coarse) {
        std::vector<std::uint32_t> fineRow;
        std::vector<std::uint32_t> coarseRow;
        // With the fine row above, the front is inside when u runs down; else when it runs up.
        for (int i = 0; i <= kAround; ++i) {
            const int u = fine > coarse ? kAround - i : i;
            fineRow.push_back(mSurface.add(insidePoint(u, fine)));
            if (i % 2 == 0) {
                coarseRow.push_back(mSurface.add(insidePoint(u, coarse)));
            }
        }
        mSurface.addHalving(fineRow, coarseRow);
    }

    /// The hole's outline: radius at an angle, in half diamonds. A superellipse with hollow sides
    /// and its tips towards the diamond's.
    static double holeRadius(double angle, double size, double power) {
        constexpr double kSoftTip = 0.09;
        const double a = std::hypot(std::cos(angle), kSoftTip);
        const double b = std::hypot(std::sin(angle), kSoftTip);
        return size * std::pow(std::pow(a, power) + std::pow(b, power), -1.0 / power);
    }

    void addOpenwork() {
        for (int row = 0; row < kDiamondRows; ++row) {
            for (int tile = 0; tile < kTiles; ++tile) {
                addDiamond(tile, row);
            }
        }
        for (int tile = 0; tile < kTiles; ++tile) {
            addHalfDiamond(tile, false);
            addHalfDiamond(tile, true);
        }
    }

    /// v on the lattice of the openwork, in steps of half a diamond's height over its segments:
    /// equal to the bit for all that meet there.
    [[nodiscard]] double latticeV(int step) const {
        constexpr int kSteps = (kDiamondRows + 1) * kTileSegments;
        return step == kSteps ? mPiercedTo
                              : mPiercedFrom + (mPiercedTo - mPiercedFrom) * step / kSteps;
    }

    /// Fills the band's zigzag border to a straight one: triangles that stand or hang between two
    /// diamonds. The last one crosses the seam; its chart goes on past the right edge of the
    /// wall's chart, where there is room for it.
    void addHalfDiamond(int tile, bool top) {
        constexpr int n = kTileSegments;
        for (const bool inside : {false, true}) {
            const auto addFacing = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                inside != top ? mSurface.addTriangle(a, c, b) : mSurface.addTriangle(a, b, c);
            };
            std::vector<std::uint32_t> before;
            for (int row = 0; row <= n; ++row) {
                const double v = latticeV(top ? (kDiamondRows + 1) * n - row : row);
                std::vector<std::uint32_t> current;
                for (int k = 0; k <= n - row; ++k) {
                    const double u = (tile + 0.5) * n + 0.5 * row + k;
                    current.push_back(
                        mSurface.add(inside ? insidePoint(u, v) : outsidePoint(u, v)));
                }
                for (std::size_t k = 0; k + 1 < before.size(); ++k) {
                    addFacing(before[k], before[k + 1], current[k]);
                    if (k + 1 < current.size()) {
                        addFacing(before[k + 1], current[k + 1], current[k]);
                    }
                }
                before = std::move(current);
            }
        }
    }

    void addDiamond(int tile, int row) {
        constexpr int kFlatRings = 2;
        constexpr int kRimRings = 6;         // even: the charts meet in the middle of the wall
        constexpr double kRimInChart = 0.24; // half diamonds: half a wall's thickness
        constexpr int n = kTileSegments;
        struct Spoke {
            double u, v;         ///< on the diamond's border
            double angle;        ///< as seen with width and height 2
            double cosine, sine; ///< of the angle
        };
        // Even rows stand between the columns' lines, odd ones on them.
        const double middleU = (tile + (row % 2 == 0 ? 0.5 : 1.0)) * n;
        const double middleV = latticeV((row + 1) * n);
        std::vector<Spoke> spokes;
        for (int i = 0; i < 4 * n; ++i) { // counter-clockwise from the lowest point
            const int k = i % n;
            const int x = i < n ? k : i < 2 * n ? n - k : i < 3 * n ? -k : k - n;
            const int y = i < n ? k - n : i < 2 * n ? k : i < 3 * n ? n - k : -k;
            Spoke spoke{};
            spoke.u = middleU + 0.5 * x;
            spoke.v = latticeV((row + 1) * n + y);
            spoke.angle = std::atan2(y, x);
            spoke.cosine = x / std::hypot(x, y);
            spoke.sine = y / std::hypot(x, y);
            spokes.push_back(spoke);
        }
        const auto onTile = [&](const Spoke& spoke, double radius) {
            return glm::dvec2(middleU + 0.5 * n * radius * spoke.cosine,
                              middleV + 0.5 * mDiamondHeight * radius * spoke.sine);
        };
        const auto edge = [](const Spoke& spoke) { return holeRadius(spoke.angle, 0.93, 0.82); };
        const auto waist = [](const Spoke& spoke) { return holeRadius(spoke.angle, 0.85, 0.76); };

        std::vector<std::vector<std::uint32_t>> rings;
        const auto addRing = [&](bool inside, auto&& point) {
            std::vector<std::uint32_t> ring;
            for (const Spoke& spoke : spokes) {
                const auto [uv, w, chart] = point(spoke);
                ring.push_back(
                    mSurface.add({wall(uv.x, uv.y, w), inside ? insideChart(chart.x, chart.y)
                                                              : outsideChart(chart.x, chart.y)}));
            }
            rings.push_back(std::move(ring));
        };
        struct RingPoint {
            glm::dvec2 uv;
            double w;
            glm::dvec2 chart;
        };
        const auto addFlat = [&](bool inside) {
            for (int k = 0; k < kFlatRings; ++k) {
                const double t = static_cast<double>(inside ? kFlatRings - 1 - k : k) / kFlatRings;
                addRing(inside, [&](const Spoke& spoke) {
                    // The border itself exactly, where the neighbors have it.
                    const glm::dvec2 border(spoke.u, spoke.v);
                    const glm::dvec2 uv =
                        t == 0.0 ? border : glm::mix(border, onTile(spoke, edge(spoke)), t);
                    return RingPoint{uv, inside ? 1.0 : 0.0, uv};
                });
            }
        };
        const auto addRim = [&](int from, int to, bool inside) {
            for (int k = from; k <= to; ++k) {
                const double phi = glm::pi<double>() * k / kRimRings;
                addRing(inside, [&](const Spoke& spoke) {
                    const double bulge = edge(spoke) - waist(spoke);
                    const double turn = 2.0 * std::min(k, kRimRings - k) / kRimRings;
                    return RingPoint{onTile(spoke, edge(spoke) - bulge * std::sin(phi)),
                                     0.5 * (1.0 - std::cos(phi)),
                                     onTile(spoke, edge(spoke) - kRimInChart * turn)};
                });
            }
        };
        const auto joinRings = [&](std::size_t first, std::size_t last) {
            for (std::size_t r = first; r < last; ++r) {
                for (std::size_t i = 0; i < spokes.size(); ++i) {
                    const std::size_t next = (i + 1) % spokes.size();
                    mSurface.addQuad(rings[r][i], rings[r][next], rings[r + 1][next],
                                     rings[r + 1][i]);
                }
            }
        };
        addFlat(false);
        addRim(0, kRimRings / 2, false);
        joinRings(0, rings.size() - 1);
        const std::size_t second = rings.size();
        addRim(kRimRings / 2, kRimRings, true);
        addFlat(true);
        joinRings(second, rings.size() - 1);
    }

    /// Over the edge of the mouth, a half ellipse; its outer half belongs to the outside's chart.
    void addLip() {
        constexpr int kHalf = 4;
        const double v = mOuter.length();
        const glm::dvec2 tangent = mOuter.tangent(v);
        const double bulge = 0.75 * thickness(v);
        const auto point = [&](int u, int k, bool inside) {
            const double phi = 0.5 * glm::pi<double>() * k / kHalf;
            const double past = 1.2 * bulge * (inside ? 2 * kHalf - k : k) / kHalf;
            SurfacePoint p;
            const double w = 0.5 * (1.0 - std::cos(phi));
            // At both ends the wall itself exactly.
            const double height = k == 2 * kHalf ? 0.0 : bulge * std::sin(phi);
            p.position = wall(u, v, w) + turned(height * tangent, u);
            p.chart = inside ? insideChart(u, v + past) : outsideChart(u, v + past);
            return p;
        };
        mSurface.addGrid(kAround, kHalf,
                         [&](int column, int row) { return point(column, kHalf - row, false); });
        mSurface.addGrid(kAround, kHalf, [&](int column, int row) {
            return point(kAround - column, kHalf + row, true);
        });
    }

    /// What closes the wall at the axis, seen from above or from below.
    void addDisc(const ProfileCurve& profile, glm::dvec2 center, int columns, bool fromAbove) {
        const double outer = profile.length();
        const int rings = std::max(4, static_cast<int>(outer / 1.6));
        const int step = kAround / columns;
        const auto point = [&](int column, int ring) {
            const double s = outer * ring / rings;
            const int u = column * step;
            const double angle = glm::two_pi<double>() * column / columns;
            const glm::dvec2 direction(std::sin(angle),
                                       fromAbove ? std::cos(angle) : -std::cos(angle));
            // The outermost ring is the wall's own, to the bit.
            const glm::dvec3 position = ring > 0    ? turned(profile.at(s), u)
                                        : fromAbove ? wall(u, mInnerFrom, 1.0)
                                                    : wall(u, 0.0, 0.0);
            return SurfacePoint{position, center + (outer - s) * direction};
        };
        mSurface.addGrid(columns, rings - 1, [&](int column, int ring) {
            return point(fromAbove ? columns - column : column, ring);
        });
        const std::uint32_t middle = mSurface.add({{0.0, profile.at(outer).y, 0.0}, center});
        std::vector<std::uint32_t> last;
        for (int column = 0; column <= columns; ++column) {
            last.push_back(mSurface.add(point(fromAbove ? columns - column : column, rings - 1)));
        }
        for (std::size_t i = 0; i + 1 < last.size(); ++i) {
            mSurface.addTriangle(last[i], middle, last[i + 1]);
        }
    }

    ProfileCurve mOuter;     ///< (radius, height) from the foot's ring to the lip
    ProfileCurve mUnderside; ///< from the foot's ring to the axis
    ProfileCurve mBowl{{{1.0, 0.0}, {0.0, 0.0}}}; ///< the inside's bottom, down to the axis
    double mDiamondHeight = 0.0;
    double mPiercedFrom = 0.0, mPiercedTo = 0.0; ///< v of the openwork
    double mShoulderTo = 0.0, mFootTo = 0.0, mInnerFrom = 0.0;

    double mChartWidth = 0.0, mChartSide = 0.0, mOutsideTop = 0.0, mInsideTop = 0.0;
    glm::dvec2 mBowlCenter{0.0}, mUndersideCenter{0.0};
    SurfaceBuilder mSurface;
};

} // namespace

Scene makeVase() {
    return Vase().make();
}

} // namespace celadon
