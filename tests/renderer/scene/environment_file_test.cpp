#include "renderer/scene/environment.h"
#include "subedit/errors.h"

#include <OpenImageIO/imageio.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace celadon {
namespace {

namespace fs = std::filesystem;

class EnvironmentFile : public testing::Test {
protected:
    EnvironmentFile()
        : mFolder(fs::path(testing::TempDir()) /
                  (std::string("celadon_environment_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::create_directories(mFolder);
    }
    ~EnvironmentFile() override { fs::remove_all(mFolder); }

    /// Writes a picture, channels as given; every value is that of `value(x, y, channel)`.
    template<class Value>
    fs::path write(const std::string& name, int width, int height,
                   const std::vector<std::string>& channels, Value&& value, int tile = 0) {
        OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()),
                             OIIO::TypeDesc::FLOAT);
        spec.channelnames = channels;
        spec.tile_width = spec.tile_height = tile;
        std::vector<float> pixels;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (std::size_t c = 0; c < channels.size(); ++c) {
                    pixels.push_back(value(x, y, channels[c]));
                }
            }
        }
        const fs::path file = mFolder / name;
        auto output = OIIO::ImageOutput::create(file.string());
        EXPECT_TRUE(output && output->open(file.string(), spec) &&
                    output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
        return file;
    }

    static std::string refusal(const fs::path& file) {
        try {
            (void)readEnvironment(file);
        } catch (const InputError& error) {
            return error.what();
        }
        ADD_FAILURE() << file << " was read";
        return {};
    }

    fs::path mFolder;
};

float encoded(int x, int y, const std::string& channel) {
    return static_cast<float>(x + 100 * y) + (channel == "R"   ? 0.25f
                                              : channel == "G" ? 0.5f
                                                               : 0.75f);
}

TEST_F(EnvironmentFile, ChannelsAreFoundByName) {
    for (const std::vector<std::string>& channels :
         {std::vector<std::string>{"R", "G", "B"}, {"A", "B", "G", "R"}, {"B", "G", "R", "Z"}}) {
        for (const int tile : {0, 16}) {
            const EnvironmentMap map =
                readEnvironment(write("map.exr", 140, 70, channels, encoded, tile));
            ASSERT_EQ(map.width, 140);
            ASSERT_EQ(map.height, 70);
            for (const int x : {0, 17, 139}) {
                for (const int y : {0, 63, 64, 69}) {
                    const float base = static_cast<float>(x + 100 * y);
                    EXPECT_EQ(map.radiance[static_cast<std::size_t>(y * 140 + x)],
                              glm::vec3(base + 0.25f, base + 0.5f, base + 0.75f));
                }
            }
            EXPECT_TRUE(map.warnings.empty());
        }
    }
}

TEST_F(EnvironmentFile, NegativePixelsAreClampedAndCounted) {
    const EnvironmentMap map = readEnvironment(
        write("map.exr", 8, 4, {"R", "G", "B"},
              [](int x, int y, const std::string&) { return y == 1 && x < 3 ? -0.5f : 1.0f; }));
    ASSERT_EQ(map.warnings.size(), 1u);
    EXPECT_THAT(map.warnings[0], testing::HasSubstr("3 of 32"));
    EXPECT_EQ(map.radiance[8], glm::vec3(0.0f));
    EXPECT_EQ(map.radiance[11], glm::vec3(1.0f));
}

TEST_F(EnvironmentFile, NanAndInfinityAreRefusedWithTheirPlace) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()}) {
        const fs::path file =
            write("map.exr", 8, 4, {"R", "G", "B"}, [&](int x, int y, const std::string& channel) {
                return x == 5 && y == 2 && channel == "G" ? bad : 1.0f;
            });
        EXPECT_THAT(refusal(file), testing::HasSubstr("(5, 2)"));
    }
}

TEST_F(EnvironmentFile, WhatIsNoEnvironmentIsRefused) {
    const auto one = [](int, int, const std::string&) { return 1.0f; };
    EXPECT_THAT(refusal(mFolder / "none.exr"), testing::HasSubstr("no such file"));
    EXPECT_THAT(refusal(mFolder), testing::HasSubstr("not a file"));
    EXPECT_THAT(refusal(write("grey.exr", 8, 4, {"Y"}, one)), testing::HasSubstr("'R'"));
    EXPECT_THAT(refusal(write("red.exr", 8, 4, {"R", "G"}, one)), testing::HasSubstr("'B'"));
    EXPECT_THAT(refusal(write("picture.png", 8, 4, {"R", "G", "B"}, one)),
                testing::HasSubstr("png"));
    EXPECT_THAT(refusal(write("wide.exr", 16385, 1, {"R", "G", "B"}, one)),
                testing::HasSubstr("16384"));
    std::ofstream(mFolder / "text.exr") << "this is no picture";
    EXPECT_THAT(refusal(mFolder / "text.exr"), testing::HasSubstr("text.exr"));
    std::ofstream(mFolder / "empty.hdr").flush();
    EXPECT_THAT(refusal(mFolder / "empty.hdr"), testing::HasSubstr("empty.hdr"));
    std::ofstream(mFolder / "lying.hdr")
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8000 +X 16000\n";
    EXPECT_THAT(refusal(mFolder / "lying.hdr"), testing::HasSubstr("lying.hdr"));
}

TEST_F(EnvironmentFile, TruncationIsRefusedAtEveryLength) {
    for (const std::string name : {"map.exr", "map.hdr"}) {
        const fs::path file = write(name, 32, 16, {"R", "G", "B"}, encoded);
        const auto size = fs::file_size(file);
        for (const double fraction : {0.9, 0.5, 0.1, 0.01}) {
            fs::resize_file(file,
                            static_cast<std::uintmax_t>(static_cast<double>(size) * fraction));
            EXPECT_THAT(refusal(file), testing::HasSubstr(name));
        }
    }
}

TEST_F(EnvironmentFile, AnUnusualShapeIsReadWithAWarning) {
    const EnvironmentMap map = readEnvironment(write(
        "square.hdr", 16, 16, {"R", "G", "B"}, [](int, int, const std::string&) { return 1.0f; }));
    ASSERT_EQ(map.warnings.size(), 1u);
    EXPECT_THAT(map.warnings[0], testing::HasSubstr("16 x 16"));
}

TEST(EnvironmentModels, RealMapsKeepTheirIntegral) {
    const char* models = std::getenv("CELADON_MODELS");
    if (models == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    for (const char* name :
         {"forest_zip_half.exr", "forest_dwab.exr", "san_giuseppe_irradiance.hdr"}) {
        const EnvironmentMap map = readEnvironment(fs::path(models) / "env" / name);
        EXPECT_EQ(map.width, 2 * map.height);
        EXPECT_EQ(map.warnings.size(), std::string(name).find("forest") == 0 ? 1u : 0u) << name;
        glm::dvec3 whole(0.0);
        for (int y = 0; y < map.height; ++y) {
            const double band = std::cos(glm::pi<double>() * y / map.height) -
                                std::cos(glm::pi<double>() * (y + 1) / map.height);
            for (int x = 0; x < map.width; ++x) {
                whole += glm::dvec3(map.radiance[static_cast<std::size_t>(y * map.width + x)]) *
                         (glm::two_pi<double>() / map.width * band);
            }
        }
        const std::vector<Light> lights = environmentLights(map, 128);
        EXPECT_EQ(lights.size(), 128u);
        glm::dvec3 sum(0.0);
        for (const Light& light : lights) {
            sum += light.color;
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c] / whole[c], 1.0, 1e-9) << name;
        }
    }
}

} // namespace
} // namespace celadon
