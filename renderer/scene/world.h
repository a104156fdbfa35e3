#pragma once

#include "renderer/scene/scene.h"
#include "subedit/map/material_map.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The scene in world millimeters with its SubEdit materials resolved: what every solver and every
/// pass takes. World millimeters are model units times millimetersPerUnit, origin and axes
/// unchanged.
namespace celadon {

class HandleGround;

using MaterialPointer = std::shared_ptr<const subedit::MaterialMap>;

struct WorldMesh {
    Mesh mesh; ///< positions in mm; uvs always present where `scattering` >= 0
    int scattering =
        -1; ///< index into World::materials; -1: opaque (shadows and is seen, gives no samples)
};

struct World {
    std::vector<WorldMesh> meshes;
    std::vector<SurfaceMaterial> looks; ///< Mesh::material indexes these
    std::vector<Image> images;
    std::vector<MaterialPointer> materials; ///< at least one
    std::vector<Camera> cameras;            ///< in mm
    std::vector<Light> lights;              ///< positions in mm
    double millimetersPerUnit = 1.0;
    BoundingSphere scatteringSphere; ///< mm, over scattering meshes; its diameter is R_w
    BoundingSphere sceneSphere;      ///< mm, over everything
    bool hasAutomaticAtlas = false;  ///< texture coordinates that the model did not have
    std::vector<std::string> warnings;
    std::shared_ptr<const Rig> rig; ///< of animations, in model units; null: none
    /// Of these meshes, for all who move them; null: each makes its own.
    std::shared_ptr<HandleGround> handleGround;
};

/// How long a model unit is: given, or from the wanted diameter of the scattering meshes' bounding
/// sphere, or from the file, or such that this diameter is 100 mm.
struct WorldScale {
    std::optional<double> millimetersPerUnit;
    std::optional<double> diameterMm;
};

/// @param diameterInUnits of the scattering meshes' bounding sphere, in model units, above 0
/// @throws UsageError: both are given, or one that is no positive number
[[nodiscard]] double chooseMillimetersPerUnit(const Scene& scene, const WorldScale& scale,
                                              double diameterInUnits);

/// What scatters (DESIGN section 1): with `override`, every mesh; else the meshes whose look names
/// a SubEdit file (`namedMaterials[i]` is that of Scene::materials[i], null: opaque); if none does,
/// every mesh takes `fallback`. Scattering meshes without uvs get one automatic atlas together.
/// @throws InputError: nothing scatters, a degenerate scene (bounding radius 0 or not finite)
[[nodiscard]] World buildWorld(Scene scene, const MaterialPointer& override,
                               const std::vector<MaterialPointer>& namedMaterials,
                               const MaterialPointer& fallback, const WorldScale& scale);

/// The same model of another size: lengths times a factor, materials as they are.
/// @throws InputError for a size that numbers do not reach
[[nodiscard]] World resized(World world, double factor);

} // namespace celadon
