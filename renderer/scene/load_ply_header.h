#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The header of a PLY file: what follows it, and how it is encoded.
namespace celadon::loaders {

enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };
enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

[[nodiscard]] std::size_t sizeOf(PlyType type);
[[nodiscard]] bool isReal(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    bool isList = false;
    PlyType countType = PlyType::UInt8; ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The least that one record can take; 0 without properties.
    [[nodiscard]] std::uint64_t leastBytes(bool text) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::size_t dataOffset = 0;
    std::uint64_t lines = 0; ///< of the header, "end_header" included
};

/// @throws InputError with the line. Counts are not held against the size of the file yet.
[[nodiscard]] PlyHeader readPlyHeader(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
