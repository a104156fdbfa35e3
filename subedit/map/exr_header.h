#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

/// The header of an OpenEXR file, read by ourselves and checked against the size of the file before
/// an image library, which allocates what a header claims, gets to see it.
namespace celadon::subedit {

struct ExrHeader {
    enum class PixelType { Uint = 0, Half = 1, Float = 2 };

    struct Attribute {
        std::string type; ///< as OpenEXR names it: "int", "float", "string", ...
        std::string data; ///< bytes as they lie in the file
    };

    int width = 0;
    int height = 0;
    std::map<std::string, PixelType> channels;
    std::map<std::string, Attribute> attributes; ///< those whose name begins with "subedit:"

    /// @throws InputError naming the attribute, its expected type and its own
    [[nodiscard]] int intAttribute(const std::filesystem::path& file,
                                   const std::string& name) const;
    [[nodiscard]] float floatAttribute(const std::filesystem::path& file,
                                       const std::string& name) const;
    [[nodiscard]] std::string stringAttribute(const std::filesystem::path& file,
                                              const std::string& name) const;
};

/// @throws InputError if the file cannot be opened, is no single-part OpenEXR image, is cut short
///         within its header, or claims more pixels than its size can hold
[[nodiscard]] ExrHeader readExrHeader(const std::filesystem::path& file);

} // namespace celadon::subedit
