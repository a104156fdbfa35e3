#include "renderer/scene/write_obj.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <unistd.h>

namespace celadon {
namespace {

constexpr std::size_t kFlushBytes = 1 << 20;

/// Writes beside the target and takes its name at the end; removes what it wrote otherwise.
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& file)
        : mFile(file),
          mTemporary(file.string() + fmt::format(".{}.tmp", ::getpid())),
          mHandle(std::fopen(mTemporary.c_str(), "wb")) {
        if (mHandle == nullptr) {
            fail(std::strerror(errno));
        }
    }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile() {
        if (mHandle != nullptr) {
            std::fclose(mHandle);
        }
        if (!mDone) {
            std::error_code ignored;
            std::filesystem::remove(mTemporary, ignored);
        }
    }

    void write(const fmt::memory_buffer& text) {
        if (std::fwrite(text.data(), 1, text.size(), mHandle) != text.size()) {
            fail(std::strerror(errno));
        }
    }

    void finish() {
        std::FILE* handle = mHandle;
        mHandle = nullptr;
        if (std::fclose(handle) != 0) {
            fail(std::strerror(errno));
        }
        std::error_code error;
        std::filesystem::rename(mTemporary, mFile, error);
        if (error) {
            fail(error.message());
        }
        mDone = true;
    }

private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw OutputError(fmt::format("'{}'", mFile.string()), "cannot be written: " + reason,
                          "choose a folder that exists and has room");
    }

    std::filesystem::path mFile;
    std::filesystem::path mTemporary;
    std::FILE* mHandle;
    bool mDone = false;
};

/// Names may not break the line that they stand on.
std::string objectName(const Mesh& mesh, std::size_t number) {
    std::string name = mesh.name.empty() ? fmt::format("mesh_{}", number) : mesh.name;
    for (char& c : name) {
        if (static_cast<unsigned char>(c) <= ' ') {
            c = '_';
        }
    }
    return name;
}

} // namespace

void writeObj(std::span<const Mesh* const> meshes, const std::filesystem::path& file) {
    OutputFile output(file);
    fmt::memory_buffer text;
    const auto line = [&](auto format, const auto&... values) {
        fmt::format_to(std::back_inserter(text), format, values...);
        if (text.size() > kFlushBytes) {
            output.write(text);
            text.clear();
        }
    };
    // Indices count from 1 over the whole file, for each kind by itself.
    std::size_t positions = 1, uvs = 1, normals = 1;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Mesh& mesh = *meshes[m];
        line(FMT_STRING("o {}\n"), objectName(mesh, m));
        for (const glm::vec3& p : mesh.positions) {
            line(FMT_STRING("v {:.9g} {:.9g} {:.9g}\n"), p.x, p.y, p.z);
        }
        for (const glm::vec2& uv : mesh.uvs) {
            line(FMT_STRING("vt {:.9g} {:.9g}\n"), uv.x, 1.0 - static_cast<double>(uv.y));
        }
        for (const glm::vec3& n : mesh.normals) {
            line(FMT_STRING("vn {:.9g} {:.9g} {:.9g}\n"), n.x, n.y, n.z);
        }
        const auto corner = [&](std::size_t i) {
            const std::size_t v = mesh.indices[i];
            if (!mesh.uvs.empty() && !mesh.normals.empty()) {
                return fmt::format(FMT_STRING("{}/{}/{}"), positions + v, uvs + v, normals + v);
            }
            if (!mesh.uvs.empty()) {
                return fmt::format(FMT_STRING("{}/{}"), positions + v, uvs + v);
            }
            if (!mesh.normals.empty()) {
                return fmt::format(FMT_STRING("{}//{}"), positions + v, normals + v);
            }
            return fmt::format(FMT_STRING("{}"), positions + v);
        };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            line(FMT_STRING("f {} {} {}\n"), corner(i), corner(i + 1), corner(i + 2));
        }
        positions += mesh.positions.size();
        uvs += mesh.uvs.size();
        normals += mesh.normals.size();
    }
    output.write(text);
    output.finish();
}

void writeObj(const Scene& scene, const std::filesystem::path& file) {
    std::vector<const Mesh*> meshes;
    for (const Mesh& mesh : scene.meshes) {
        meshes.push_back(&mesh);
    }
    writeObj(meshes, file);
}

} // namespace celadon
