#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>

namespace celadon::subedit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MaterialFile : public testing::Test {
protected:
    /// Writes a map, lets `damage` at its bytes, and reads it again.
    void expectRefused(const std::function<void(std::string&)>& damage,
                       const testing::Matcher<std::string>& message,
                       const MaterialMap& map = test::varyingMaterial(8, 8, 4)) {
        writeMaterial(map, file, StoredPrecision::Float);
        std::string bytes = content(file);
        damage(bytes);
        std::ofstream(file, std::ios::binary) << bytes;
        expectUnreadable(message);
    }

    void expectUnreadable(const testing::Matcher<std::string>& message) {
        try {
            static_cast<void>(readMaterial(file));
            FAIL() << "was read";
        } catch (const InputError& error) {
            EXPECT_THAT(std::string(error.what()), AllOf(HasSubstr(file.string()), message));
            EXPECT_EQ(error.exitCode(), ExitCode::Input);
        }
    }

    static std::string content(const std::filesystem::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// Overwrites the value of a 4-byte attribute.
    template<typename T>
    static void patch(std::string& bytes, const std::string& name, const std::string& type,
                      T value) {
        const std::string key = name + '\0' + type + '\0';
        const std::size_t at = bytes.find(key);
        ASSERT_NE(at, std::string::npos) << name;
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[at + key.size() + 4 + i] = static_cast<char>(bits >> (8 * i));
        }
    }

    static void rename(std::string& bytes, const std::string& from, const std::string& to) {
        const std::size_t at = bytes.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        bytes.replace(at, from.size(), to);
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "test.subedit.exr";
};

TEST_F(MaterialFile, FloatsComeBackBitForBit) {
    MaterialMap map = test::varyingMaterial(7, 5, 24);
    map.name = "nacre ñ";
    for (int i = 0; i < 35; ++i) {
        map.roughness.push_back(static_cast<float>(i) / 35.0f);
        map.specular.push_back(static_cast<float>(35 - i) / 35.0f);
    }
    writeMaterial(map, file, StoredPrecision::Float);
    std::vector<std::string> warnings;
    const MaterialMap read = readMaterial(file, &warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(read.name, map.name);
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.segments, 24);
    EXPECT_EQ(read.maxRadiusMm, map.maxRadiusMm);
    EXPECT_EQ(read.eta, map.eta);
    EXPECT_EQ(read.logProfile, map.logProfile);
    EXPECT_EQ(read.roughness, map.roughness);
    EXPECT_EQ(read.specular, map.specular);
}

TEST_F(MaterialFile, TheSameMaterialIsTheSameBytes) {
    const MaterialMap map = test::varyingMaterial(7, 5, 8);
    writeMaterial(map, file);
    const std::string first = content(file);
    EXPECT_THAT(first, HasSubstr("1970:01:01")); // and not the time of writing
    writeMaterial(map, folder / "again.subedit.exr");
    EXPECT_EQ(content(folder / "again.subedit.exr"), first);
}

TEST_F(MaterialFile, WhatCouldNotBeReadIsNotWritten) {
    MaterialMap map = test::varyingMaterial(2, 2, 4);
    map.maxRadiusMm = 2e6f;
    EXPECT_THROW(writeMaterial(map, file), OutputError);
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(MaterialFile, KnotsPast99AreFoundByName) {
    const MaterialMap map = test::exponentialMaterial(130, 13.0f, {1.0f, 2.0f, 3.0f});
    writeMaterial(map, file, StoredPrecision::Float);
    EXPECT_EQ(readMaterial(file).logProfile, map.logProfile);
}

TEST_F(MaterialFile, HalvesKeepTheAlbedo) {
    for (const int segments : {8, 24, 64}) {
        const MaterialMap map = test::varyingMaterial(16, 16, segments);
        writeMaterial(map, file);
        const MaterialMap read = readMaterial(file);
        const std::vector<float> before = albedoMap(map);
        const std::vector<float> after = albedoMap(read);
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_NEAR(after[i] / before[i], 1.0f, 1e-3f) << segments;
        }
        for (std::size_t i = 0; i < map.logProfile.size(); ++i) {
            // One step of half precision at most: 1/64 where |ln P| is in [16, 32).
            EXPECT_NEAR(read.logProfile[i], map.logProfile[i], 1.0f / 64.0f);
        }
    }
}

/// With few knots there is little to choose from, and near 1 there is a limit.
TEST_F(MaterialFile, HalvesKeepTheAlbedoOfFewSegmentsAndStayBelowOne) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (const int segments : {1, 2, 3, 4, 8, 24}) {
        MaterialMap map = test::varyingMaterial(16, 16, segments);
        for (float& value : map.logProfile) {
            value += 0.2f * unit(random);
        }
        const std::vector<float> made = albedoMap(map);
        std::vector<float> wanted;
        const auto knots = static_cast<std::size_t>(map.knots());
        for (std::size_t i = 0; i < made.size(); ++i) {
            wanted.push_back(i % 2 == 0 ? 1.0f : 0.2f + 0.7f * unit(random));
            const std::size_t texel = i / 3;
            for (std::size_t k = 0; k < knots; ++k) {
                map.logProfile[(texel * knots + k) * 3 + i % 3] += std::log(wanted[i] / made[i]);
            }
        }
        for (float& value : map.logProfile) {
            value = std::max(value, kLogProfileFloor);
        }
        writeMaterial(map, file);
        const std::vector<float> before = albedoMap(map);
        const std::vector<float> after = albedoMap(readMaterial(file));
        for (std::size_t i = 0; i < before.size(); ++i) {
            // A step of half precision is 1/512 to 1/64 here, and few knots leave little choice.
            EXPECT_NEAR(after[i] / before[i], 1.0f, segments < 8 ? 3e-3f : 1e-3f) << segments;
            if (i % 2 == 0) {
                EXPECT_LE(after[i], 1.0f + 3e-6f) << segments << ", " << before[i];
            }
        }
    }
}

TEST_F(MaterialFile, ValuesNearZeroAndTheFloorSurviveHalfPrecision) {
    MaterialMap map = test::exponentialMaterial(3, 1.0f, {1.0f, 1.0f, 1.0f});
    map.logProfile = {0.0f,   1e-6f,  -1e-6f, 1.0f, 2.0f,   -1.0f,
                      -99.0f, -30.0f, -29.9f, 0.5f, -0.25f, 4.0f};
    writeMaterial(map, file);
    const MaterialMap read = readMaterial(file);
    for (std::size_t i = 0; i < map.logProfile.size(); ++i) {
        EXPECT_NEAR(read.logProfile[i], std::max(map.logProfile[i], kLogProfileFloor),
                    1.0f / 64.0f);
    }
}

TEST_F(MaterialFile, AlbedoAboveOneIsReadAndReported) {
    const MaterialMap map = test::exponentialMaterial(8, 20.0f, {4.0f, 1.0f, 1.0f}, 1.0f);
    writeMaterial(map, file, StoredPrecision::Float);
    std::vector<std::string> warnings;
    EXPECT_EQ(readMaterial(file, &warnings).logProfile, map.logProfile);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], HasSubstr("albedo above 1"));
}

TEST_F(MaterialFile, WhatIsNoMaterialIsRefused) {
    expectUnreadable(HasSubstr("no such file"));
    std::ofstream(file) << "";
    expectUnreadable(HasSubstr("not an OpenEXR file"));
    std::ofstream(file) << "PNG or something else, long enough to be looked at";
    expectUnreadable(HasSubstr("not an OpenEXR file"));
    file = folder.path();
    expectUnreadable(HasSubstr("is not a file"));
}

TEST_F(MaterialFile, TruncationAnywhereIsRefused) {
    writeMaterial(test::varyingMaterial(32, 32, 4), file, StoredPrecision::Float);
    const std::string whole = content(file);
    for (int i = 0; i < 40; ++i) {
        const std::size_t length = whole.size() * static_cast<std::size_t>(i) / 40;
        std::ofstream(file, std::ios::binary) << whole.substr(0, length);
        expectUnreadable(HasSubstr("'"));
    }
}

TEST_F(MaterialFile, MissingAttributesAndChannelsAreNamed) {
    for (const std::string name : {"subedit:version", "subedit:segments", "subedit:maxRadius",
                                   "subedit:eta", "subedit:name"}) {
        expectRefused([&](std::string& bytes) { rename(bytes, name, "other" + name.substr(5)); },
                      AllOf(HasSubstr(name), HasSubstr("is missing")));
    }
    expectRefused([](std::string& bytes) { rename(bytes, "P03.G", "P03.H"); },
                  AllOf(HasSubstr("P03.G"), HasSubstr("is missing")));
    expectRefused(
        [](std::string& bytes) { patch(bytes, "subedit:segments", "int", std::uint32_t{200}); },
        AllOf(HasSubstr("P05.R"), HasSubstr("is missing")));
}

TEST_F(MaterialFile, ChannelsBeyondTheLastKnotAreRefused) {
    expectRefused(
        [](std::string& bytes) { patch(bytes, "subedit:segments", "int", std::uint32_t{2}); },
        AllOf(HasSubstr("P03.R"), HasSubstr("is one too many")));
}

TEST_F(MaterialFile, RoughnessOutsideItsRangeIsClampedAndReported) {
    MaterialMap map = test::varyingMaterial(3, 1, 4);
    map.roughness = {-0.5f, 0.5f, 1.5f};
    writeMaterial(map, file, StoredPrecision::Float);
    std::vector<std::string> warnings;
    EXPECT_EQ(readMaterial(file, &warnings).roughness, (std::vector<float>{0.0f, 0.5f, 1.0f}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], HasSubstr("2 values of roughness and specular"));
}

TEST_F(MaterialFile, AttributesOfTheWrongTypeAreRefused) {
    expectRefused(
        [](std::string& bytes) {
            const std::string key("subedit:maxRadius\0float", 23);
            rename(bytes, key, std::string("subedit:maxRadius\0fl0at", 23));
        },
        AllOf(HasSubstr("subedit:maxRadius"), HasSubstr("'fl0at' instead of 'float'")));
}

TEST_F(MaterialFile, ImpossibleNumbersAreRefused) {
    for (const std::uint32_t segments : {0u, 257u, 0xffffffffu, 0x7fffffffu}) {
        expectRefused(
            [&](std::string& bytes) { patch(bytes, "subedit:segments", "int", segments); },
            AllOf(HasSubstr("subedit:segments"), HasSubstr("1..256")));
    }
    for (const float radius : {0.0f, -1.0f, std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN()}) {
        expectRefused(
            [&](std::string& bytes) { patch(bytes, "subedit:maxRadius", "float", radius); },
            HasSubstr("subedit:maxRadius"));
    }
    for (const float eta : {0.0f, -1.3f, 100.0f, std::numeric_limits<float>::quiet_NaN()}) {
        expectRefused([&](std::string& bytes) { patch(bytes, "subedit:eta", "float", eta); },
                      HasSubstr("subedit:eta"));
    }
    expectRefused(
        [](std::string& bytes) { patch(bytes, "subedit:version", "int", std::uint32_t{2}); },
        HasSubstr("subedit:version"));
}

TEST_F(MaterialFile, ValuesThatAreNoProfileAreRefusedWithTheirPlace) {
    for (const float value : {std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), 41.0f, 3e38f}) {
        MaterialMap map = test::varyingMaterial(70, 70, 4);
        map.logProfile[map.index(65, 66, 2) + 1] = value; // single precision is written as it is
        writeMaterial(map, file, StoredPrecision::Float);
        expectUnreadable(AllOf(HasSubstr("P02.G"), HasSubstr("(65, 66)")));
    }
}

TEST_F(MaterialFile, SizesThatTheFileCannotHoldAreRefusedBeforeAllocation) {
    const auto resize = [](std::int32_t width, std::int32_t height) {
        return [=](std::string& bytes) {
            const std::string key("dataWindow\0box2i\0", 17);
            const std::size_t at = bytes.find(key);
            ASSERT_NE(at, std::string::npos);
            const std::int32_t edges[] = {0, 0, width - 1, height - 1};
            for (std::size_t i = 0; i < 16; ++i) {
                const auto bits = std::bit_cast<std::uint32_t>(edges[i / 4]);
                bytes[at + key.size() + 4 + i] = static_cast<char>(bits >> (8 * (i % 4)));
            }
        };
    };
    expectRefused(resize(30000, 30000), HasSubstr("cannot hold"));
    expectRefused(resize(8, 32000), HasSubstr("cannot hold"));
    expectRefused(resize(2000000000, 2000000000), HasSubstr("1 to 32768"));
    expectRefused(resize(-5, 8), HasSubstr("claims -5 x 8"));
    expectRefused(resize(8, 100), HasSubstr("rows"));
}

TEST_F(MaterialFile, AnyFlippedByteIsReadOrRefusedButNeverCrashes) {
    writeMaterial(test::varyingMaterial(6, 6, 2), file);
    const std::string whole = content(file);
    std::uint32_t state = 1;
    for (int i = 0; i < 400; ++i) {
        state = state * 1664525u + 1013904223u;
        std::string bytes = whole;
        bytes[(state >> 8) % std::min<std::size_t>(bytes.size(), 1500)] =
            static_cast<char>(state >> 3);
        std::ofstream(file, std::ios::binary) << bytes;
        try {
            const MaterialMap map = readMaterial(file);
            EXPECT_EQ(map.logProfile.size(), static_cast<std::size_t>(map.width) *
                                                 static_cast<std::size_t>(map.height) *
                                                 static_cast<std::size_t>(map.knots()) * 3);
        } catch (const InputError&) {
        }
    }
}

TEST_F(MaterialFile, AFailedWriteLeavesTheEarlierFile) {
    const MaterialMap map = test::varyingMaterial(4, 4, 2);
    writeMaterial(map, file);
    const std::string before = content(file);
    EXPECT_THROW(writeMaterial(map, folder / "absent" / "x.subedit.exr"), OutputError);
    EXPECT_THROW(writeMaterial(map, folder / "x.subedit.png"), OutputError);
    EXPECT_THROW(writeMaterial(map, folder.path()), OutputError);
    EXPECT_EQ(content(file), before);
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        ++files;
    }
    EXPECT_EQ(files, 1u) << "a temporary file was left behind";
}

} // namespace
} // namespace celadon::subedit
