#include "subedit/errors.h"
#include "subedit/map/range_table_file.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace celadon::subedit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TableFile makeTable() {
    const MaterialMap map = test::varyingMaterial(8, 8, 16);
    const MeanProfile mean = meanProfile(map, effectiveRadiusMap(map));
    const RangeTable table = RangeTable::build(mean, 0.01);
    TableFile file;
    file.epsilon = 0.01;
    file.energy = 0.95;
    for (std::size_t i = 0; i < mean.samples().size(); ++i) {
        file.r.push_back(static_cast<double>(i) / static_cast<double>(mean.samples().size() - 1));
        file.meanProfile.push_back(mean.samples()[i]);
    }
    for (std::size_t i = 0; i < table.values().size(); ++i) {
        file.T.push_back(std::exp2(static_cast<double>(i) / kRangeTableEntriesPerOctave));
        file.minimalRadius.push_back(static_cast<double>(table.values()[i]));
    }
    return file;
}

TEST(RangeTableFile, CsvAndExrGiveTheTableBack) {
    const test::TemporaryFolder folder;
    const TableFile table = makeTable();
    std::ofstream(folder / "t.csv") << tableCsv(table);
    writeTableExr(table, folder / "t.exr");
    const RangeTable fromCsv = readRangeTable(folder / "t.csv");
    const RangeTable fromExr = readRangeTable(folder / "t.exr");
    for (std::size_t i = 0; i < table.T.size(); ++i) {
        EXPECT_NEAR(fromCsv.values()[i], table.minimalRadius[i], 1e-6) << i;
        // Resampled to 512 entries: at a step of the table, between the values beside it.
        const double low = std::min(table.minimalRadius[i],
                                    table.minimalRadius[std::min(i + 1, table.T.size() - 1)]);
        const double high = table.minimalRadius[i > 0 ? i - 1 : 0];
        EXPECT_GE(static_cast<double>(fromExr.values()[i]), low - 0.12) << i;
        EXPECT_LE(static_cast<double>(fromExr.values()[i]), std::max(high, low) + 0.12) << i;
    }
    const TableFile read = readTable(folder / "t.exr");
    EXPECT_NEAR(read.epsilon, 0.01, 1e-6);
    EXPECT_NEAR(read.T.back(), 4096.0, 1.0);
    EXPECT_NEAR(read.meanProfile.front() / table.meanProfile.front(), 1.0, 1e-5);
}

TEST(RangeTableFile, OtherRangesOfTAreInterpolated) {
    const std::array<double, 3> T{2.0, 8.0, 32.0};
    const std::array<double, 3> radius{1.0, 0.5, 0.1};
    const RangeTable table = RangeTable::fromSamples(T, radius);
    EXPECT_FLOAT_EQ(table.minimalRadius(1.5f), 1.0f);
    EXPECT_FLOAT_EQ(table.minimalRadius(8.0f), 0.5f);
    EXPECT_NEAR(table.minimalRadius(16.0f), 0.3f, 1e-6f); // halfway in log2 T
    EXPECT_FLOAT_EQ(table.minimalRadius(4000.0f), 0.1f);
}

TEST(RangeTableFile, HostileTablesAreRefused) {
    const auto expectRefused = [](const char* text, const testing::Matcher<std::string>& says) {
        try {
            static_cast<void>(parseTableCsv(text, "t.csv"));
            FAIL() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("t.csv"), HasSubstr("profile table"), says));
        }
    };
    expectRefused("", HasSubstr("no minimal radii"));
    expectRefused("r,meanProfile\n0,1\n", HasSubstr("no minimal radii"));
    expectRefused("1,2\n", HasSubstr("line 1"));
    expectRefused("T,minimalRadius\n1,x\n", HasSubstr("line 2"));
    expectRefused("T,minimalRadius\n1,nan\n", HasSubstr("line 2"));
    expectRefused("T,minimalRadius\n2,1\n1,1\n", HasSubstr("rising"));
    expectRefused("T,minimalRadius\n0,1\n", HasSubstr("positive"));
    expectRefused("T,minimalRadius\n1,1.5\n", HasSubstr("[0, 1]"));
    const test::TemporaryFolder folder;
    std::ofstream(folder / "no.exr") << "no picture";
    EXPECT_THROW(static_cast<void>(readTable(folder / "no.exr")), InputError);
    EXPECT_THROW(static_cast<void>(readTable(folder / "absent.csv")), InputError);
    // A material is an EXR too, but no table.
    writeTableExr(makeTable(), folder / "t.exr");
    EXPECT_NO_THROW(static_cast<void>(readTable(folder / "t.exr")));
}

} // namespace
} // namespace celadon::subedit
