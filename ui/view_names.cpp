#include "ui/view_names.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace celadon::ui {

namespace {

constexpr std::array<ViewName, 11> kNames{{
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
    {ViewMode::Atlas, "atlas", "Atlas with charts",
     "The map itself: albedo, and the borders of the charts that the surface is cut into"},
    {ViewMode::Irradiance, "irradiance", "Irradiance buffer",
     "What one light sees of the surface, and its mips: flux per texel, the brightest white"},
    {ViewMode::Samples, "samples", "Selected samples",
     "The samples that stand for the lit surface, colored by level; faint where they are hidden"},
    {ViewMode::Difference, "difference", "Difference to truth",
     "Error against the sum over all lit texels (image-reference), worked out in the background"},
}};

std::string choices() {
    std::string words;
    for (const ViewName& name : kNames) {
        words += (words.empty() ? "choose " : ", ") + std::string(name.word);
    }
    return words;
}

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
    throw UsageError(fmt::format("view '{}'", word), "there is no such view", choices());
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
