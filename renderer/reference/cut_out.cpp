#include "renderer/reference/cut_out.h"

#include <glm/common.hpp>

#include <cmath>

namespace celadon {

namespace {

/// Texel that GL reads for a texel beyond the picture (OpenGL 4.5, table 8.20).
int wrapped(int i, int size, Wrap wrap) {
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    switch (wrap) {
    case Wrap::Repeat:
        return modulo(i, size);
    case Wrap::MirroredRepeat: {
        const int place = modulo(i, 2 * size);
        return place < size ? place : 2 * size - 1 - place;
    }
    case Wrap::ClampToEdge:
        break;
    }
    return glm::clamp(i, 0, size - 1);
}

/// A coordinate that means the same, and near 0.
double nearby(double u, Wrap wrap) {
    return wrap == Wrap::ClampToEdge ? glm::clamp(u, -1.0, 2.0)
                                     : u - 2.0 * std::floor(0.5 * u); // mirrored: a period of 2
}

double texelAlpha(const Image& image, const TextureReference& texture, int x, int y) {
    const auto row = static_cast<std::size_t>(wrapped(y, image.height, texture.wrapV));
    const auto column = static_cast<std::size_t>(wrapped(x, image.width, texture.wrapU));
    return image.rgba[4 * (row * static_cast<std::size_t>(image.width) + column) + 3] / 255.0;
}

double textureAlpha(const Image& image, const TextureReference& texture, glm::dvec2 uv) {
    uv = glm::dvec2(glm::dmat3(texture.transform) * glm::dvec3(uv, 1.0));
    const glm::dvec2 near(nearby(uv.x, texture.wrapU), nearby(uv.y, texture.wrapV));
    const glm::dvec2 place =
        near * glm::dvec2(image.width, image.height) - (texture.nearest ? 0.0 : 0.5);
    const glm::ivec2 texel(glm::floor(place));
    if (texture.nearest) {
        return texelAlpha(image, texture, texel.x, texel.y);
    }
    const glm::dvec2 part = place - glm::dvec2(texel);
    const auto row = [&](int y) {
        return glm::mix(texelAlpha(image, texture, texel.x, y),
                        texelAlpha(image, texture, texel.x + 1, y), part.x);
    };
    return glm::mix(row(texel.y), row(texel.y + 1), part.y);
}

/// Of the values at a triangle's vertices.
template<typename Value>
auto interpolated(const Mesh& mesh, const TrianglePoint& place, const std::vector<Value>& values) {
    using Wide = glm::vec<Value::length(), double>;
    const std::uint32_t* const corner = mesh.indices.data() + 3 * std::size_t{place.triangle};
    return (1.0 - place.u - place.v) * Wide(values[corner[0]]) + place.u * Wide(values[corner[1]]) +
           place.v * Wide(values[corner[2]]);
}

} // namespace

bool mayBeCutOut(const World& world, const Mesh& mesh) {
    const auto look = static_cast<std::size_t>(mesh.material);
    return look < world.looks.size() && world.looks[look].alphaCutoff.has_value();
}

bool isCutOut(const World& world, const TrianglePoint& place) {
    const Mesh& mesh = world.meshes[static_cast<std::size_t>(place.mesh)].mesh;
    if (!mayBeCutOut(world, mesh)) {
        return false;
    }
    const SurfaceMaterial& look = world.looks[static_cast<std::size_t>(mesh.material)];
    const TextureReference& texture = look.baseColorTexture;
    double alpha = static_cast<double>(look.baseColor.a);
    if (!mesh.colors.empty()) {
        alpha *= interpolated(mesh, place, mesh.colors).a;
    }
    if (texture.isSet()) {
        const std::vector<glm::vec2>& uvs =
            texture.uvSet == 1 && !mesh.uvs1.empty() ? mesh.uvs1 : mesh.uvs;
        const glm::dvec2 uv = uvs.empty() ? glm::dvec2(0.0) : interpolated(mesh, place, uvs);
        alpha *= textureAlpha(world.images[static_cast<std::size_t>(texture.image)], texture, uv);
    }
    return alpha < static_cast<double>(*look.alphaCutoff);
}

} // namespace celadon
