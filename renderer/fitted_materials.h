#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/scene/world.h"
#include "subedit/map/texel_rect.h"

#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// The materials as pictures are made of them: the world's own maps, or smaller ones of those that
/// the driver cannot hold. No GL here.
namespace celadon {

class FittedMaterials {
public:
    /// Whether there is room for maps of these sizes, all at once.
    /// @param sizes width, height and knots of each
    using HasRoom = std::function<bool(std::span<const glm::ivec3> sizes)>;

    /// The largest map is halved until all have room. Where no size helps, all are left as they
    /// are.
    /// @param beforeEach called before a map is made, which takes a second or two a gigabyte; what
    ///                   it throws ends it. May be empty
    FittedMaterials(std::span<const MaterialPointer> materials, const HasRoom& hasRoom,
                    const std::function<void()>& beforeEach = {});

    [[nodiscard]] std::span<const MaterialPointer> maps() const { return mMaps; }
    /// One for each map that is smaller than the world's.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return mWarnings; }

    /// Texels of a material of the world have been edited; its size stays.
    /// @return what has changed of maps(); not empty
    [[nodiscard]] MaterialChange update(int material, const subedit::MaterialMap& map,
                                        const subedit::TexelRect& rect);

private:
    std::vector<MaterialPointer> mMaps;
    std::vector<std::shared_ptr<subedit::MaterialMap>> mSmaller; ///< null where the world's serves
    std::vector<std::string> mWarnings;
};

} // namespace celadon
