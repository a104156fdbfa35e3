#include "ui/view_names.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <array>

namespace celadon::ui {

namespace {

constexpr std::array<ViewName, 7> kNames{{
    {ViewMode::Picture, "picture", "Picture", "Light that leaves towards the camera, tone mapped"},
    {ViewMode::Exitance, "exitance", "Radiant exitance B",
     "Scattered light that leaves the surface per area, W/m\xc2\xb2, without highlights"},
    {ViewMode::ExitanceLevel, "level", "Exitance of a level",
     "B of one level of the splatting buffer, coarser levels included"},
    {ViewMode::EffectiveRadius, "radius", "Effective radius",
     "Radius R_P that holds 95 % of the scattered energy, mm; blue is short, red is long"},
    {ViewMode::Albedo, "albedo", "Diffuse albedo", "Part of the light that comes out again"},
    {ViewMode::Normals, "normals", "Normals", "Directions that the surface faces"},
    {ViewMode::TextureCoordinates, "uv", "Texture coordinates",
     "Where on the material's map the surface lies; 32 squares a side"},
}};

} // namespace

std::span<const ViewName> viewNames() {
    return kNames;
}

ViewMode parseViewMode(std::string_view word) {
    for (const ViewName& name : kNames) {
        if (name.word == word) {
            return name.mode;
        }
    }
    throw UsageError(fmt::format("view '{}'", word), "there is no such view",
                     "choose picture, exitance, level, radius, albedo, normals or uv");
}

const ViewName& viewName(ViewMode mode) {
    for (const ViewName& name : kNames) {
        if (name.mode == mode) {
            return name;
        }
    }
    return kNames.front();
}

} // namespace celadon::ui
