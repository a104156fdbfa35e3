#include "app/material/response_table.h"
#include "renderer/output/image_io.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/load_scene.h"
#include "subedit/document/stroke_file.h"
#include "subedit/errors.h"
#include "subedit/fit/measured_curve.h"
#include "subedit/map/material_file.h"
#include "subedit/map/range_table_file.h"
#include "tests/support/materials.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <sys/resource.h>

/// Files of every kind but plain meshes (load_hostile_test has those), damaged at random with fixed
/// seeds: each is read, or refused by an InputError of one line. CELADON_MUTATIONS=N tries more;
/// the preset asan-ubsan looks at every access.
namespace celadon::app {
namespace {

using test::TemporaryFolder;

int variants(int usual) {
    const char* const wanted = std::getenv("CELADON_MUTATIONS");
    return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// Flipped bytes, a cut, a part that is repeated or left out, or a number that is another.
std::string mutated(std::string content, bool isText, std::mt19937& random) {
    static const std::vector<std::string> kNumbers{
        "-1",         "0",    "1e39", "4294967295", "nan",  "inf", "18446744073709551616",
        "",           "[]",   "{}",   "null",       "\"\"", "1.5", "-0",
        "2147483647", "true", "1e-45"};
    const auto within = [&](std::size_t size) { return size == 0 ? 0 : random() % size; };
    switch (random() % (isText ? 5 : 4)) {
    case 0:
    case 1:
        for (auto flips = 1 + random() % 4; flips > 0 && !content.empty(); --flips) {
            const std::size_t reach =
                random() % 2 == 0 ? std::min<std::size_t>(content.size(), 600) : content.size();
            content[within(reach)] = static_cast<char>(random());
        }
        return content;
    case 2:
        return content.substr(0, within(content.size()));
    case 3: {
        const std::size_t from = within(content.size());
        const std::size_t length = within(std::min<std::size_t>(content.size() - from, 200));
        return random() % 2 == 0 ? content.erase(from, length)
                                 : content.insert(from, content.substr(from, length));
    }
    default: {
        const std::size_t at = content.find_first_of("0123456789-", within(content.size()));
        if (at == std::string::npos) {
            return content;
        }
        const std::size_t end = content.find_first_not_of("0123456789.-+e", at);
        return content.replace(at, end == std::string::npos ? 1 : end - at,
                               kNumbers[within(kNumbers.size())]);
    }
    }
}

/// Reads each mutant of a file with `read`; both outcomes have to occur.
template<typename Read>
void tryMutants(const std::filesystem::path& file, bool isText, int count, const Read& read) {
    const std::string whole = test::readText(file);
    ASSERT_FALSE(whole.empty());
    ASSERT_NO_THROW(read()) << "the file as it should be";
    std::mt19937 random(4711);
    int refused = 0;
    for (int i = 0; i < variants(count); ++i) {
        test::writeText(file, mutated(whole, isText, random));
        try {
            read();
        } catch (const InputError& error) {
            ++refused;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        } catch (const std::exception& error) {
            FAIL() << "mutant " << i << " ended in " << error.what();
        }
    }
    EXPECT_GT(refused, 0);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 2'000'000) << "kB: a number in a file was believed";
}

const subedit::MaterialMap& material() {
    static const subedit::MaterialMap map = *test::chessboardMaterial();
    return map;
}

TEST(MutatedFiles, Materials) {
    const TemporaryFolder folder;
    const auto file = folder / "m.subedit.exr";
    writeMaterial(material(), file);
    tryMutants(file, false, 200, [&] { static_cast<void>(subedit::readMaterial(file)); });
}

TEST(MutatedFiles, Environments) {
    const TemporaryFolder folder;
    const auto file = folder / "e.exr";
    FloatImage image;
    image.width = 32;
    image.height = 16;
    image.channels = {"R", "G", "B"};
    image.pixels.assign(32 * 16 * 3, 0.5f);
    writeExr(file, image);
    tryMutants(file, false, 200, [&] { static_cast<void>(readEnvironment(file)); });
}

TEST(MutatedFiles, RangeTables) {
    const TemporaryFolder folder;
    const auto table = folder / "t.csv";
    subedit::TableFile content;
    for (int i = 0; i <= 20; ++i) {
        content.r.push_back(0.05 * i);
        content.meanProfile.push_back(std::exp(-0.2 * i));
        content.T.push_back(std::exp2(0.5 * i));
        content.minimalRadius.push_back(0.04 * i);
    }
    test::writeText(table, subedit::tableCsv(content));
    tryMutants(table, true, 400, [&] { static_cast<void>(subedit::readTable(table)); });
}

TEST(MutatedFiles, MeasuredProfiles) {
    const TemporaryFolder folder;
    const auto file = folder / "p.csv";
    test::writeText(
        file, "r_mm,R,G,B\n0,1,0.5,0.25\n0.5,0.3,0.2,0.1\n1.5,0.1,0.05,0.02\n4,1e-3,1e-3,1e-4\n");
    tryMutants(file, true, 600, [&] { static_cast<void>(subedit::readProfileCsv(file)); });
}

TEST(MutatedFiles, MeasuredResponses) {
    const TemporaryFolder folder;
    const auto file = folder / "r.csv";
    test::writeText(file, "u_in,v_in,u_out,v_out,r_mm,R,G,B\n0.1,0.2,0.3,0.4,2,0.1,0.05,0.02\n"
                          "0.5,0.5,0.6,0.5,1,0.2,0.1,0.05\n");
    tryMutants(file, true, 600,
               [&] { static_cast<void>(parseResponseCsv(readTextFile(file), "'r.csv'")); });
}

TEST(MutatedFiles, Strokes) {
    const TemporaryFolder folder;
    const auto file = folder / "s.json";
    test::writeText(file, R"({"format": "celadon-strokes", "version": 1,
        "surface": {"flatWidthMm": 100, "texels": [64, 64]}, "commands": [
        {"command": "stroke", "operator": {"name": "scale-albedo", "factor": [0.5, 0.5, 0.5]},
         "brush": {"radiusMm": 4, "hardness": 0.5}, "path": [{"positionMm": [1, 2, 3],
         "normal": [0, 0, 1], "pressure": 0.5}, {"uv": [0.5, 0.5]}],
         "mirror": {"axes": "xz", "centerMm": [0, 0, 0]}},
        {"command": "stamp", "operator": {"name": "mix", "profile": {"maxRadiusMm": 5,
         "knots": [[0, 0, 0], [-3, -4, -5]]}}, "at": {"uv": [0.5, 0.5]}, "widthMm": 5,
         "pixels": [2, 2], "weights": "00ff7f80"},
        {"command": "apply", "operator": {"name": "scale-range", "factor": [2, 2, 2]}}]})");
    tryMutants(file, true, 600, [&] { static_cast<void>(subedit::readStrokeFile(file)); });
}

TEST(MutatedFiles, Deformers) {
    const TemporaryFolder folder;
    const auto file = folder / "d.json";
    test::writeText(file, R"({"deformers": [
        {"type": "twist", "axis": "y", "angleDegrees": 90, "range": [0.2, 1]},
        {"type": "bend", "axis": "y", "angleDegrees": {"times": [0, 2], "values": [0, 60], "interpolation": "cubic"}},
        {"type": "lattice", "size": [3, 3, 3], "moves": [{"point": [1, 2, 1], "by": [0, 0.2, 0]}]},
        {"type": "handles", "handles": [{"at": [0, 0, 0], "radius": 0.1},
            {"at": [0, 1, 0], "radius": 0.1, "move": [0.3, 0, 0], "turnDegrees": [0, 0, -30]}]}]})");
    tryMutants(file, true, 600, [&] { static_cast<void>(loaders::readDeformers(file)); });
}

/// glTFs as people have them: skins, morph targets, sparse accessors, textures, extensions.
TEST(MutatedFiles, RealModels) {
    const char* const models = std::getenv("CELADON_MODELS");
    if (models == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const TemporaryFolder folder;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(models) / "gltf")) {
        const std::filesystem::path& seed = entry.path();
        const bool isText = seed.extension() == ".gltf";
        if (!entry.is_regular_file() || (!isText && seed.extension() != ".glb") ||
            entry.file_size() > 100'000 || seed.stem().string().ends_with("_draco")) {
            continue;
        }
        SCOPED_TRACE(seed.string());
        const auto file = folder / seed.filename().string();
        std::filesystem::copy_file(seed, file);
        tryMutants(file, isText, 60, [&] { static_cast<void>(loadScene(file)); });
    }
}

} // namespace
} // namespace celadon::app
