#pragma once

#include "renderer/scene/load_scene.h"
#include "subedit/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

/// Small model files for the tests of the readers.
namespace celadon::loadtest {

/// A folder of its own that goes away with it.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "celadon-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        mPath = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return mPath; }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = mPath / name;
        std::ofstream(file, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        return file;
    }

private:
    std::filesystem::path mPath;
};

/// The message with which a file is refused; fails the test when it is read.
inline std::string refusal(const std::filesystem::path& file) {
    try {
        (void)loadScene(file);
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_THAT(message, testing::HasSubstr("'"));
        return message;
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

/// Bytes of values as they lie in memory.
template<typename T>
std::string bytesOf(const std::vector<T>& values) {
    std::string result(values.size() * sizeof(T), '\0');
    std::memcpy(result.data(), values.data(), result.size());
    return result;
}

template<typename T>
std::string bytesOf(T value) {
    return bytesOf(std::vector<T>{value});
}

/// A glTF under construction: `json` may be changed at will before it is written.
struct GltfBuilder {
    nlohmann::json json;
    std::string binary;

    GltfBuilder() {
        json["asset"]["version"] = "2.0";
        json["scene"] = 0;
        json["scenes"] = {{{"nodes", {0}}}};
        json["nodes"] = {{{"mesh", 0}}};
    }

    int addView(const std::string& bytes, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4);
        nlohmann::json view{
            {"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride != 0) {
            view["byteStride"] = stride;
        }
        json["bufferViews"].push_back(view);
        binary += bytes;
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    int addAccessor(int view, const char* type, int componentType, std::size_t count,
                    std::size_t offset = 0) {
        json["accessors"].push_back({{"bufferView", view},
                                     {"type", type},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"byteOffset", offset}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    int addFloats(const std::vector<float>& values, const char* type) {
        const std::size_t components = type == std::string("SCALAR") ? 1
                                       : type == std::string("VEC2") ? 2
                                       : type == std::string("VEC3") ? 3
                                       : type == std::string("VEC4") ? 4
                                                                     : 16;
        return addAccessor(addView(bytesOf(values)), type, 5126, values.size() / components);
    }

    template<typename T>
    int addIndices(const std::vector<T>& values) {
        const int type = sizeof(T) == 1 ? 5121 : sizeof(T) == 2 ? 5123 : 5125;
        return addAccessor(addView(bytesOf(values)), "SCALAR", type, values.size());
    }

    /// One mesh of one triangle: (0,0,0) (1,0,0) (0,1,0), which faces +z.
    void addTriangle() {
        const int positions = addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    [[nodiscard]] nlohmann::json finished() const {
        nlohmann::json result = json;
        if (!result.contains("buffers") && !binary.empty()) {
            result["buffers"] = {{{"byteLength", binary.size()}}};
        }
        return result;
    }

    [[nodiscard]] std::string glb() const {
        std::string text = finished().dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string data = binary;
        data.resize((data.size() + 3) / 4 * 4);
        const auto u32 = [](std::size_t value) {
            return bytesOf(static_cast<std::uint32_t>(value));
        };
        return "glTF" + u32(2) + u32(12 + 8 + text.size() + 8 + data.size()) + u32(text.size()) +
               "JSON" + text + u32(data.size()) + std::string("BIN\0", 4) + data;
    }
};

} // namespace celadon::loadtest
