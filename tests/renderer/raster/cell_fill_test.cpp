// What vector code fills against the same said plainly, a sample at a time.
#include "renderer/raster/cell_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace celadon {
namespace {

constexpr glm::ivec2 kSize(45, 37); // no whole number of cells
constexpr int kRows = 37;

SampleBand emptyBand(const SampleCells& cells) {
    const auto samples = static_cast<std::size_t>(cells.columns() * kRows) * cells.groups() *
                         std::size_t{SampleCells::kLanes};
    SampleBand band;
    band.rows = {0, kRows - 1};
    band.triangles.assign(samples, 0);
    band.depths.assign(samples, 0.0f);
    band.centerDepths.assign(samples, 0.0f);
    band.touched.assign(kRows, {std::numeric_limits<int>::max(), -1});
    return band;
}

void fillPlainly(const SampleCells& cells, SampleBand& band, const FilledTriangle& filled) {
    std::array<ScreenVertex, 3> t = filled.corners;
    const std::int64_t area = (std::int64_t{t[1].x} - t[0].x) * (std::int64_t{t[2].y} - t[0].y) -
                              (std::int64_t{t[2].x} - t[0].x) * (std::int64_t{t[1].y} - t[0].y);
    if (area == 0) {
        return;
    }
    const DepthPlane plane(t, area);
    if (area < 0) {
        std::swap(t[1], t[2]);
    }
    const std::array edges{EdgeFunction(t[0], t[1]), EdgeFunction(t[1], t[2]),
                           EdgeFunction(t[2], t[0])};
    const std::size_t lanes = cells.x().size();
    for (std::size_t i = 0; i < band.triangles.size(); ++i) {
        const auto cell = static_cast<int>(i / lanes);
        const int left = cell % cells.columns() * cells.width() * kSubpixels;
        const int low = cell / cells.columns() * kSubpixels;
        const int x = left + cells.x()[i % lanes];
        const int y = low + cells.y()[i % lanes];
        const auto z = std::clamp(static_cast<float>(plane.at(x, y)), plane.least, plane.greatest);
        const bool isInside =
            x < kSize.x * kSubpixels &&
            std::ranges::all_of(edges, [&](const EdgeFunction& e) { return e.at(x, y) >= 0; });
        if (isInside && z > band.depths[i] &&
            (filled.isHole == nullptr || !(*filled.isHole)(x, y))) {
            band.depths[i] = z;
            band.triangles[i] = filled.number;
            band.centerDepths[i] = static_cast<float>(plane.at(left + 128, low + 128));
        }
    }
}

class CellFill : public testing::TestWithParam<FillFunction> {};

TEST_P(CellFill, SeesWhatSamplesSeeOneByOne) {
    std::mt19937 random(7);
    const auto between = [&](int low, int high) {
        return std::uniform_int_distribution(low, high)(random);
    };
    std::vector<SamplePlace> places{{128, 128}};
    for (const std::size_t count : {1, 5, 8, 17}) { // cells of pixels; one, two and three vectors
        while (places.size() < count) {
            places.push_back({between(0, 255), between(0, 255)});
        }
        const SampleCells cells(places, kSize);
        SampleBand band = emptyBand(cells);
        SampleBand expected = emptyBand(cells);
        const std::function<bool(int, int)> holes = [](int x, int y) {
            return (x / 700 + y / 900) % 2 == 1;
        };
        for (std::uint32_t number = 1; number <= 400; ++number) {
            // Slivers of a pixel up to triangles far beyond the picture.
            const int reach = 60 << between(0, 13);
            const glm::ivec2 about(between(-2000, 14000), between(-2000, 12000));
            std::array<ScreenVertex, 3> corners;
            for (ScreenVertex& corner : corners) {
                corner = {about.x + between(-reach, reach), about.y + between(-reach, reach),
                          static_cast<float>(between(0, 1000)) / 1000.0f, false};
            }
            if (number % 9 == 0) {
                corners[2] = corners[0];
            }
            const FilledTriangle triangle{corners, number, number % 5 == 0 ? &holes : nullptr};
            GetParam()(cells, band, triangle);
            fillPlainly(cells, expected, triangle);
        }
        int seen = 0;
        for (std::size_t i = 0; i < expected.triangles.size(); ++i) {
            const std::size_t lanes = cells.x().size();
            const int pixel = static_cast<int>(i / lanes) % cells.columns() * cells.width() +
                              cells.x()[i % lanes] / kSubpixels;
            if (pixel >= kSize.x) {
                continue; // a cell's pixels beyond the picture: nobody takes them
            }
            ASSERT_EQ(band.triangles[i], expected.triangles[i]) << count << " places, " << i;
            if (expected.triangles[i] == 0) {
                continue;
            }
            ++seen;
            const float z = expected.depths[i];
            EXPECT_NEAR(double(band.depths[i]), double(z), 2e-7);
            if (count > 1) {
                const float center = std::max(expected.centerDepths[i], 1e-3f * z);
                EXPECT_NEAR(double(band.centerDepths[i]), double(center),
                            1e-6 * std::max(1.0, double(center)));
            }
            const RasterRange& touched =
                band.touched[i / lanes / static_cast<std::size_t>(cells.columns())];
            const int column = static_cast<int>(i / lanes) % cells.columns();
            EXPECT_TRUE(touched.first <= column && column <= touched.last);
        }
        EXPECT_GT(seen, 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, CellFill,
                         testing::Values(chooseFillFunction(), fillCellsPortable));

} // namespace
} // namespace celadon
