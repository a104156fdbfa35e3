#include "tests/renderer/scene/atlas_shapes.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>

namespace celadon::test {
namespace {

constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;

void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

float part(int i, int count) {
    return static_cast<float>(i) / static_cast<float>(count);
}

} // namespace

Mesh makeSphere(int slices, int stacks, glm::vec3 center, float radius) {
    Mesh mesh;
    const auto add = [&](float theta, float phi) {
        mesh.positions.push_back(center + radius * glm::vec3(std::sin(theta) * std::cos(phi),
                                                             std::cos(theta),
                                                             -std::sin(theta) * std::sin(phi)));
    };
    add(0.0f, 0.0f);
    for (int j = 1; j < stacks; ++j) {
        for (int i = 0; i < slices; ++i) {
            add(0.5f * kTurn * part(j, stacks), kTurn * part(i, slices));
        }
    }
    add(0.5f * kTurn, 0.0f);
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(1 + (j - 1) * slices + i % slices);
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int i = 0; i < slices; ++i) {
        mesh.indices.insert(mesh.indices.end(), {0u, at(i, 1), at(i + 1, 1)});
        for (int j = 1; j + 1 < stacks; ++j) {
            addQuad(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
        mesh.indices.insert(mesh.indices.end(), {last, at(i + 1, stacks - 1), at(i, stacks - 1)});
    }
    return mesh;
}

Mesh makeTorus(int around, int across) {
    Mesh mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const float a = kTurn * part(i, around);
            const float b = kTurn * part(j, across);
            const float r = 1.0f + 0.4f * std::cos(b);
            mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.4f * std::sin(b));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            addQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh;
}

Mesh makeCube() {
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(i & 1 ? 1 : 0, i & 2 ? 1 : 0, i & 4 ? 1 : 0);
    }
    addQuad(mesh, 0, 2, 3, 1);
    addQuad(mesh, 4, 5, 7, 6);
    addQuad(mesh, 0, 1, 5, 4);
    addQuad(mesh, 2, 6, 7, 3);
    addQuad(mesh, 0, 4, 6, 2);
    addQuad(mesh, 1, 3, 7, 5);
    return mesh;
}

Mesh makeCylinder(int slices, int stacks) {
    Mesh mesh;
    for (int j = 0; j <= stacks; ++j) {
        for (int i = 0; i < slices; ++i) {
            const float a = kTurn * part(i, slices);
            mesh.positions.emplace_back(std::cos(a), 4.0f * part(j, stacks), -std::sin(a));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(j * slices + i % slices);
    };
    for (int j = 0; j < stacks; ++j) {
        for (int i = 0; i < slices; ++i) {
            addQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh;
}

Mesh makeMoebiusStrip(int segments) {
    Mesh mesh;
    for (int i = 0; i < segments; ++i) {
        const float a = kTurn * part(i, segments);
        for (const float side : {-0.3f, 0.3f}) {
            const float r = 1.0f + side * std::cos(0.5f * a);
            mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a),
                                        side * std::sin(0.5f * a));
        }
    }
    for (int i = 0; i < segments; ++i) {
        const auto a = static_cast<std::uint32_t>(2 * i);
        const bool last = i + 1 == segments;
        addQuad(mesh, a, last ? 1 : a + 2, last ? 0 : a + 3, a + 1);
    }
    return mesh;
}

Mesh makeManyTetrahedra(int count, unsigned seed) {
    Mesh mesh;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (int i = 0; i < count; ++i) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 center(uniform(random), uniform(random), uniform(random));
        for (int k = 0; k < 4; ++k) {
            const glm::vec3 offset(uniform(random), uniform(random), uniform(random));
            mesh.positions.push_back(center + 0.02f * offset);
        }
        for (const std::uint32_t k : {0u, 2u, 1u, 0u, 1u, 3u, 1u, 2u, 3u, 0u, 3u, 2u}) {
            mesh.indices.push_back(base + k);
        }
    }
    return mesh;
}

Mesh makeSoup(int vertices, int triangles, unsigned seed) {
    Mesh mesh;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (int i = 0; i < vertices; ++i) {
        mesh.positions.emplace_back(uniform(random), uniform(random), uniform(random));
    }
    std::uniform_int_distribution<std::uint32_t> pick(0, static_cast<std::uint32_t>(vertices - 1));
    for (int i = 0; i < 3 * triangles; ++i) {
        mesh.indices.push_back(pick(random)); // corners may coincide
    }
    return mesh;
}

Mesh makeBook(int pages) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < pages; ++i) {
        const float a = kTurn * part(i, pages);
        const auto corner = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(std::cos(a), 0.5f, std::sin(a));
        mesh.indices.insert(mesh.indices.end(), {i % 2 ? 1u : 0u, i % 2 ? 0u : 1u, corner});
    }
    return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const std::uint32_t i : other.indices) {
        mesh.indices.push_back(base + i);
    }
}

Mesh exploded(const Mesh& mesh) {
    Mesh result;
    for (const std::uint32_t i : mesh.indices) {
        result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(mesh.positions[i]);
    }
    return result;
}

Mesh inconsistentlyWound(Mesh mesh) {
    for (std::size_t t = 0; t < mesh.triangleCount(); t += 3) {
        std::swap(mesh.indices[3 * t], mesh.indices[3 * t + 1]);
    }
    return mesh;
}

Mesh readTestModel(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw std::runtime_error("cannot open " + file);
    }
    Mesh mesh;
    const auto addPolygon = [&](const std::vector<std::uint32_t>& corners) {
        for (std::size_t i = 2; i < corners.size(); ++i) {
            mesh.indices.insert(mesh.indices.end(), {corners[0], corners[i - 1], corners[i]});
        }
    };
    std::string line;
    if (file.ends_with(".obj")) {
        while (std::getline(in, line)) {
            std::istringstream words(line.substr(std::min<std::size_t>(2, line.size())));
            if (line.starts_with("v ")) {
                glm::vec3& p = mesh.positions.emplace_back();
                words >> p.x >> p.y >> p.z;
            } else if (line.starts_with("f ")) {
                std::vector<std::uint32_t> corners;
                for (std::string word; words >> word;) {
                    corners.push_back(static_cast<std::uint32_t>(std::stoul(word) - 1));
                }
                addPolygon(corners);
            }
        }
        return mesh;
    }
    std::size_t vertices = 0, faces = 0, floats = 0;
    bool binary = false, inVertex = false;
    while (std::getline(in, line) && !line.starts_with("end_header")) {
        binary = binary || line.starts_with("format binary_little_endian");
        if (line.starts_with("element")) {
            inVertex = line.starts_with("element vertex");
            (inVertex ? vertices : faces) = std::stoul(line.substr(line.find_last_of(' ')));
        }
        floats += inVertex && line.starts_with("property") ? 1 : 0;
    }
    for (std::size_t i = 0; i < vertices; ++i) {
        glm::vec3& p = mesh.positions.emplace_back();
        if (binary) {
            std::vector<float> values(floats);
            in.read(reinterpret_cast<char*>(values.data()),
                    static_cast<std::streamsize>(4 * floats));
            p = {values[0], values[1], values[2]};
        } else {
            std::getline(in, line);
            std::istringstream(line) >> p.x >> p.y >> p.z;
        }
    }
    for (std::size_t i = 0; i < faces; ++i) {
        std::vector<std::uint32_t> corners;
        if (binary) {
            corners.resize(static_cast<std::size_t>(in.get()));
            in.read(reinterpret_cast<char*>(corners.data()),
                    static_cast<std::streamsize>(4 * corners.size()));
        } else {
            std::size_t count = 0;
            in >> count;
            corners.resize(count);
            for (std::uint32_t& corner : corners) {
                in >> corner;
            }
        }
        addPolygon(corners);
    }
    return mesh;
}

} // namespace celadon::test
