#pragma once

#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/scene.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The lights of the scene as a user handles them. No GL.
namespace celadon::ui {

struct RigLight {
    std::string name;
    bool isOn = true;
    Light light; ///< position in mm; color includes the strength
    /// Which of the model's lights it is: it goes along with the animation until it is moved.
    std::optional<std::size_t> followed = std::nullopt;

    [[nodiscard]] bool operator==(const RigLight&) const = default;
};

/// Whether lights are those of a file still: places that follow an animation do not count.
[[nodiscard]] bool areSame(std::span<const RigLight> a, std::span<const RigLight> b);

/// An environment map, kept as it was read, and how much of it is used.
struct RigEnvironment {
    std::filesystem::path file;
    std::shared_ptr<const EnvironmentMap> map;
    double strength = 1.0;
    double turnDegrees = 0.0; ///< about +y
    int lights = 24;          ///< directional lights that stand for it
};

struct LightRig {
    std::vector<RigLight> lights;
    std::optional<RigEnvironment> environment;

    /// Those that are on, as solvers take them.
    [[nodiscard]] std::vector<Light> resolved() const;
    /// The environment as a renderer takes it.
    [[nodiscard]] Environment around() const;
};

[[nodiscard]] std::vector<std::string> lightPresetNames();

/// Lights arranged about an object as seen by a camera.
/// @param name back, rim, studio, front @throws UsageError for another
[[nodiscard]] std::vector<RigLight> lightPreset(std::string_view name, const Camera& camera,
                                                const BoundingSphere& object);

/// A light of a kind that shows something at once: near the object, above and to the right, or
/// further around it where another light is.
[[nodiscard]] RigLight newLight(Light::Kind kind, const Camera& camera,
                                const BoundingSphere& object, std::span<const RigLight> others);

/// @throws UsageError
[[nodiscard]] Light::Kind parseLightKind(std::string_view name);

/// Where a light is drawn in the viewport: its position, or for a directional one a point on its
/// way to the object.
[[nodiscard]] glm::dvec3 gizmoPosition(const Light& light, const BoundingSphere& object);
/// The light after its gizmo was dragged to `position`: directional and spot lights aim at the
/// object's center.
[[nodiscard]] Light movedTo(const Light& light, const glm::dvec3& position,
                            const BoundingSphere& object);

/// Exposure at which what the lights reach is neither burnt out nor dark, in whole stops: for the
/// luminance that they bring to the object's center, seen as if its surface were the nearest.
/// @return 0 within a stop of the default light, and where there is none
[[nodiscard]] float fittingExposureEv(std::span<const Light> lights, const BoundingSphere& object);

/// Lights turned about the vertical axis through a point, from +z towards +x.
void turnAround(const glm::dvec3& center, std::span<RigLight> lights, double degrees);
/// The camera and all lights turned about the vertical axis through the camera's target: what is
/// seen is the object turning the other way.
void turnAround(Camera& camera, LightRig& rig, double degrees);

} // namespace celadon::ui
