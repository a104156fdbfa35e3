#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What a model file says, in memory: triangles, looks, cameras and lights, in model units and
/// world space (glTF: after node transforms). No GL here. Loaders and builtins produce it, the
/// renderer turns it into millimeters on the GPU.
namespace celadon {

struct MeshBinding; // rig.h
struct Rig;

/// An 8-bit RGBA picture, top row first.
struct Image {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< [height][width][4]
};

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };

struct TextureReference {
    int image = -1; ///< index into Scene::images; -1: none
    int uvSet = 0;  ///< 0 or 1
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    bool nearest = false;
    glm::mat3 transform{1.0f}; ///< KHR_texture_transform: uv' = transform * (u, v, 1)
    [[nodiscard]] bool isSet() const { return image >= 0; }
};

/// The look of a surface apart from its scattering: the specular lobe, and what an opaque part
/// shows.
struct SurfaceMaterial {
    std::string name;
    glm::vec4 baseColor{0.8f, 0.8f, 0.8f, 1.0f}; ///< linear
    glm::vec3 emission{0.0f};                    ///< W/m^2/sr, linear
    float metallic = 0.0f;
    float roughness = 0.35f;
    std::optional<float> ior; ///< set when the file says so; else the SubEdit material's eta
    bool doubleSided = false;
    TextureReference baseColorTexture;
    TextureReference metallicRoughnessTexture; ///< G roughness, B metallic
    TextureReference normalTexture;
    float normalScale = 1.0f;
    TextureReference emissiveTexture; ///< multiplies `emission`
    /// Where the base color's alpha is below it, there is no surface. Unset: alpha is ignored.
    std::optional<float> alphaCutoff;
    std::optional<std::filesystem::path>
        subedit; ///< the SubEdit file that the glTF names, resolved
};

/// Triangles with one look. Counter-clockwise is the front.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;   ///< model units
    std::vector<glm::vec3> normals;     ///< unit length, one per position (computed where missing)
    std::vector<glm::vec2> uvs;         ///< (0,0) top left, v down; one per position, or empty
    std::vector<glm::vec2> uvs1;        ///< second set, or empty
    std::vector<glm::vec4> colors;      ///< linear, multiply the base color; as uvs, or empty
    std::vector<std::uint32_t> indices; ///< three a triangle, all < positions.size()
    int material = 0;                   ///< index into Scene::materials
    std::shared_ptr<const MeshBinding> binding; ///< what moves it; null: nothing does
    std::vector<std::uint32_t> bindingVertices; ///< with a binding: its vertex of each position
    [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
};

/// Perspective with a vertical field of view, or orthographic with a vertical extent.
struct Camera {
    std::string name;
    glm::dvec3 eye{0.0, 0.0, 1.0};
    glm::dvec3 at{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fovYDegrees = 35.0;
    std::optional<double> orthographicHeight; ///< full height of the view in model units
};

struct Light {
    enum class Kind { Directional, Point, Spot };
    Kind kind = Kind::Directional;
    glm::dvec3 position{0.0};             ///< model units (point, spot)
    glm::dvec3 direction{0.0, -1.0, 0.0}; ///< travels along; unit length (directional, spot)
    glm::dvec3 color{1.0}; ///< W/m^2 on a plane that faces it (directional), or W/sr (point, spot)
    double innerConeRadians = 0.0; ///< half angles (spot), inner < outer <= pi/2
    double outerConeRadians = 0.7853981633974483;

    [[nodiscard]] bool operator==(const Light&) const = default;
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;               ///< none is empty
    std::vector<SurfaceMaterial> materials; ///< at least one
    std::vector<Image> images;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::optional<double> millimetersPerUnit; ///< glTF: 1000; files with no unit: unset
    std::vector<std::string> warnings;        ///< one line each, for the user
    std::shared_ptr<const Rig> rig;           ///< set when the file has animations
};

struct BoundingSphere {
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// Center of the axis-aligned box, radius the farthest vertex, over vertices that triangles use
/// (DESIGN section 1). `include` selects meshes by index; all when empty.
[[nodiscard]] BoundingSphere boundingSphere(const Scene& scene,
                                            const std::vector<bool>& include = {});
[[nodiscard]] BoundingSphere boundingSphere(std::span<const Mesh* const> meshes);

} // namespace celadon
