#include "renderer/output/image_io.h"
#include "renderer/output/tone_map.h"
#include "subedit/errors.h"
#include "tests/support/images.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

using test::messageOf;
using test::noiseImage;
using test::readText;
using test::TemporaryFolder;
using test::uniformImage;
using test::writeText;
using testing::HasSubstr;
using Names = std::vector<std::string>;

TEST(ImageFormat, FollowsTheExtension) {
    EXPECT_EQ(imageFormat("a/b.EXR"), ImageFormat::Exr);
    EXPECT_EQ(imageFormat("b.jpeg"), ImageFormat::Jpeg);
    EXPECT_EQ(imageFormat("b.tif"), ImageFormat::Tiff);
    const auto message = [](const char* name) {
        return messageOf<UsageError>([&] { static_cast<void>(imageFormat(name)); });
    };
    EXPECT_THAT(message("b.bmp"), HasSubstr(".exr, .png"));
    EXPECT_THAT(message("b"), HasSubstr("no extension"));
}

TEST(Exr, KeepsFloatsAndNamesExactly) {
    const TemporaryFolder folder;
    FloatImage image =
        noiseImage(33, 17, {"R", "G", "B", "A", "exitance.R", "position.X", "radius"}, 1);
    image.pixels[5] = -1e-30f;
    image.pixels[6] = 1e30f;
    writeExr(folder / "a.exr", image);
    const ReadImage read = readImage(folder / "a.exr");
    EXPECT_FALSE(read.displayEncoded);
    EXPECT_EQ(read.image.width, 33);
    EXPECT_EQ(read.image.height, 17);
    for (std::size_t c = 0; c < image.channelCount(); ++c) {
        const int index = read.image.channelIndex(image.channels[c]);
        ASSERT_GE(index, 0) << image.channels[c];
        for (int y = 0; y < 17; ++y) {
            for (int x = 0; x < 33; ++x) {
                ASSERT_EQ(read.image.at(x, y, index), image.at(x, y, static_cast<int>(c)));
            }
        }
    }
    EXPECT_EQ(read.image.channels[0], "R");
    EXPECT_EQ(read.image.channels[3], "A");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(Exr, TheSamePictureIsTheSameBytes) {
    const TemporaryFolder folder;
    const FloatImage image = noiseImage(9, 7, {"R", "G", "B", "A"}, 1);
    writeExr(folder / "a.exr", image);
    writeDisplayImage(folder / "a.tif", image);
    for (const char* const name : {"a.exr", "a.tif"}) { // and not the time of writing
        EXPECT_NE(readText(folder / name).find("1970:01:01"), std::string::npos) << name;
    }
}

TEST(Exr, HalvesOnlyTheColor) {
    const TemporaryFolder folder;
    const FloatImage image =
        uniformImage(4, 4, {"R", "G", "B", "A", "position.X"}, {0.1f, 0.2f, 0.3f, 1.0f, 0.1f});
    writeExr(folder / "a.exr", image, {.halfColor = true, .attributes = {{"note", "x"}}});
    const FloatImage read = readImage(folder / "a.exr").image;
    EXPECT_NE(read.at(0, 0, read.channelIndex("R")), 0.1f);
    EXPECT_NEAR(read.at(0, 0, read.channelIndex("R")), 0.1f, 1e-4f);
    EXPECT_EQ(read.at(0, 0, read.channelIndex("position.X")), 0.1f);
}

TEST(Exr, CarriesNonFiniteValues) {
    const TemporaryFolder folder;
    FloatImage image = uniformImage(2, 1, {"Y"}, {1.0f});
    image.pixels = {std::numeric_limits<float>::quiet_NaN(),
                    std::numeric_limits<float>::infinity()};
    writeExr(folder / "a.exr", image);
    const FloatImage read = readImage(folder / "a.exr").image;
    EXPECT_TRUE(std::isnan(read.pixels[0]));
    EXPECT_TRUE(std::isinf(read.pixels[1]));
}

class DisplayFile : public testing::TestWithParam<std::tuple<const char*, int, bool>> {};

TEST_P(DisplayFile, ComesBackAsLinearPremultiplied) {
    const auto [name, bits, hasAlpha] = GetParam();
    const TemporaryFolder folder;
    const FloatImage encoded =
        hasAlpha ? uniformImage(8, 8, {"R", "G", "B", "A"}, {0.8f, 0.4f, 0.2f, 0.6f})
                 : uniformImage(8, 8, {"R", "G", "B"}, {0.8f, 0.4f, 0.2f});
    writeDisplayImage(folder / name, encoded, {.bits = bits, .jpegQuality = 95, .attributes = {}});
    const ReadImage read = readImage(folder / name);
    EXPECT_TRUE(read.displayEncoded);
    ASSERT_EQ(read.image.channels, encoded.channels);
    const float coverage = hasAlpha ? 0.6f : 1.0f;
    // JPEG quantizes; the others round to their bits.
    const float tolerance = std::string(name) == "a.jpg" ? 0.02f : bits == 16 ? 3e-5f : 6e-3f;
    EXPECT_NEAR(read.image.at(3, 3, 0), decodeSrgb(0.8f) * coverage, tolerance);
    EXPECT_NEAR(read.image.at(3, 3, 1), decodeSrgb(0.4f) * coverage, tolerance);
    EXPECT_NEAR(read.image.at(3, 3, 2), decodeSrgb(0.2f) * coverage, tolerance);
    if (hasAlpha) {
        EXPECT_NEAR(read.image.at(3, 3, 3), 0.6f, tolerance);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, DisplayFile,
    testing::Values(std::tuple("a.png", 8, false), std::tuple("a.png", 8, true),
                    std::tuple("a.png", 16, true), std::tuple("a.jpg", 8, false),
                    std::tuple("a.tif", 8, true), std::tuple("a.tiff", 16, false)));

TEST(Png, HoldsEveryEightBitValueExactly) {
    const TemporaryFolder folder;
    FloatImage ramp = uniformImage(256, 1, {"R", "G", "B"}, {0, 0, 0});
    for (int x = 0; x < 256; ++x) {
        ramp.at(x, 0, 0) = static_cast<float>(x) / 255.0f;
    }
    writeDisplayImage(folder / "a.png", ramp);
    const FloatImage read = readImage(folder / "a.png").image;
    for (int x = 0; x < 256; ++x) {
        EXPECT_NEAR(encodeSrgb(read.at(x, 0, 0)) * 255.0f, static_cast<float>(x), 1e-3f);
    }
}

TEST(DisplayImage, ClampsWhatDoesNotFit) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    writeDisplayImage(folder / "a.png", uniformImage(1, 1, {"R", "G", "B"}, {-1.0f, 2.0f, nan}));
    EXPECT_EQ(readImage(folder / "a.png").image.pixels, (std::vector<float>{0.0f, 1.0f, 0.0f}));
}

TEST(DisplayImage, RefusesWhatTheFormatCannotHold) {
    const TemporaryFolder folder;
    const FloatImage rgba = uniformImage(1, 1, {"R", "G", "B", "A"}, {0, 0, 0, 0});
    const FloatImage rgb = uniformImage(1, 1, {"R", "G", "B"}, {0, 0, 0});
    EXPECT_THROW(writeDisplayImage(folder / "a.jpg", rgba), UsageError);
    EXPECT_THROW(writeDisplayImage(folder / "a.exr", rgb), UsageError);
    EXPECT_THROW(writeDisplayImage(folder / "a.jpg", rgb, {.bits = 16}), UsageError);
    EXPECT_THROW(writeDisplayImage(folder / "a.png", rgb, {.bits = 12}), UsageError);
    EXPECT_THROW(writeDisplayImage(folder / "a.png", FloatImage{}), UsageError);
    EXPECT_THROW(writeExr(folder / "a.png", rgb), UsageError);
    EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(WriteImage, KeepsTheEarlierFileWhenWritingFails) {
    const TemporaryFolder folder;
    EXPECT_THROW(writeExr(folder / "missing/a.exr", uniformImage(1, 1, {"Y"}, {0})), OutputError);
    std::filesystem::create_directory(folder / "a.exr");
    EXPECT_THROW(writeExr(folder / "a.exr", uniformImage(1, 1, {"Y"}, {0})), OutputError);
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(ReadImage, RefusesWhatIsNoPicture) {
    const TemporaryFolder folder;
    const auto message = [](const std::filesystem::path& file) {
        return messageOf<InputError>([&] { static_cast<void>(readImage(file)); });
    };
    EXPECT_THAT(message(folder / "none.exr"), HasSubstr("no such file"));
    EXPECT_THAT(message(folder.path()), HasSubstr("folder"));
    writeText(folder / "empty.png", "");
    EXPECT_THAT(message(folder / "empty.png"), HasSubstr("empty"));
    writeText(folder / "text.exr", "this is no picture\nat all");
    const std::string text = message(folder / "text.exr");
    EXPECT_THAT(text, HasSubstr("text.exr"));
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(ReadImage, RefusesEveryTruncatedFileOrReadsItsPart) {
    const TemporaryFolder folder;
    writeExr(folder / "a.exr", noiseImage(40, 40, {"R", "G", "B"}, 3));
    writeDisplayImage(folder / "a.png", noiseImage(40, 40, {"R", "G", "B"}, 3));
    for (const char* name : {"a.exr", "a.png"}) {
        const std::string bytes = readText(folder / name);
        for (std::size_t length = 1; length < bytes.size(); length += bytes.size() / 23 + 1) {
            const std::filesystem::path cut = folder / (std::string("cut-") + name);
            writeText(cut, std::string_view(bytes).substr(0, length));
            EXPECT_THROW(static_cast<void>(readImage(cut)), InputError) << name << " " << length;
        }
    }
}

TEST(ReadImage, RefusesSizesThatTheFileCannotHold) {
    const TemporaryFolder folder;
    writeExr(folder / "a.exr", uniformImage(2, 2, {"R", "G", "B"}, {1, 1, 1}));
    std::string bytes = readText(folder / "a.exr");
    // dataWindow and displayWindow are box2i: name, type, byte count 16, xMin yMin xMax yMax.
    for (const char* window : {"dataWindow", "displayWindow"}) {
        const std::size_t at = bytes.find(std::string(window) + '\0' + "box2i") +
                               std::string(window).size() + 1 + 6 + 4;
        for (std::size_t side : {at + 8, at + 12}) {
            bytes[side] = '\xff';
            bytes[side + 1] = '\x3f'; // 16383
        }
    }
    writeText(folder / "lies.exr", bytes);
    const std::string message =
        messageOf<InputError>([&] { static_cast<void>(readImage(folder / "lies.exr")); });
    EXPECT_THAT(message, HasSubstr("lies.exr"));
}

} // namespace
} // namespace celadon
