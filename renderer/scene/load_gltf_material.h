#pragma once

#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/scene.h"

/// Materials of a glTF, with the pictures that they use.
namespace celadon::loaders {

/// Fills Scene::materials (one per glTF material, in order, and then one that stands for "none")
/// and Scene::images. A picture that cannot be read is a warning.
/// @throws InputError when extras.subedit is not a relative path
void addMaterials(const GltfDocument& document, Scene& scene);

} // namespace celadon::loaders
