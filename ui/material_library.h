#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The materials that a browser offers: shipped ones, the user's own, and those used lately. No GL.
namespace celadon::ui {

struct LibraryMaterial {
    std::string label;
    std::string nameOrPath; ///< as findMaterial() takes it
    std::filesystem::path file;
};

struct MaterialLibrary {
    std::vector<LibraryMaterial> shipped, own, recent; ///< each file once, in this order
};

/// @param ownFolder   may be missing
/// @param recentFiles latest first; those that are gone are left out
[[nodiscard]] MaterialLibrary findMaterials(const std::filesystem::path& ownFolder,
                                            const std::vector<std::string>& recentFiles);

/// "yellow_wax" -> "Yellow wax"; "a/jade.subedit.exr" -> "Jade".
[[nodiscard]] std::string materialLabel(const std::string& nameOrPath);

} // namespace celadon::ui
