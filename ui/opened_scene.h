#pragma once

#include "renderer/scene/world.h"
#include "subedit/document/document.h"

#include <memory>
#include <vector>

/// A world made ready for editing: each of its materials a document, and the maps that the renderer
/// follows with.
namespace celadon::ui {

struct OpenedScene {
    World world;                                                 ///< its materials are `rendered`
    std::vector<std::shared_ptr<subedit::MaterialMap>> rendered; ///< for the picture's thread
    /// One per material; null where it cannot be painted (no texture coordinate lies on its map).
    std::vector<std::unique_ptr<subedit::Document>> documents;
};

/// Maps below this many texels a side are enlarged, so that a brush finds texels to paint.
inline constexpr int kPaintableTexels = 512;

/// May take a second: not on the window's thread.
/// @param paintable false: materials stay as they are, and there are no documents
[[nodiscard]] OpenedScene prepareScene(World world, bool paintable);

} // namespace celadon::ui
