#include "renderer/scene/load_ply_header.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_text.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace celadon::loaders {

namespace {

PlyType parseType(std::string_view word, const TextScanner& scanner) {
    static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{
        {{"char", PlyType::Int8},
         {"uchar", PlyType::UInt8},
         {"short", PlyType::Int16},
         {"ushort", PlyType::UInt16},
         {"int", PlyType::Int32},
         {"uint", PlyType::UInt32},
         {"float", PlyType::Float32},
         {"double", PlyType::Float64},
         {"int8", PlyType::Int8},
         {"uint8", PlyType::UInt8},
         {"int16", PlyType::Int16},
         {"uint16", PlyType::UInt16},
         {"int32", PlyType::Int32},
         {"uint32", PlyType::UInt32},
         {"float32", PlyType::Float32},
         {"float64", PlyType::Float64}}};
    for (const auto& [name, type] : kTypes) {
        if (word == name) {
            return type;
        }
    }
    scanner.fail(fmt::format("'{}' is not a type of PLY", excerpt(word)));
}

PlyFormat parseFormat(TextScanner& scanner) {
    const std::string_view name = scanner.wordOnLine();
    const std::string_view version = scanner.wordOnLine();
    if (version != "1.0") {
        scanner.fail(fmt::format("PLY version '{}' is not 1.0", excerpt(version)));
    }
    if (name == "ascii") {
        return PlyFormat::Ascii;
    }
    if (name == "binary_little_endian") {
        return PlyFormat::BinaryLittleEndian;
    }
    if (name == "binary_big_endian") {
        return PlyFormat::BinaryBigEndian;
    }
    scanner.fail(fmt::format("'{}' is not a format of PLY", excerpt(name)));
}

PlyProperty parseProperty(TextScanner& scanner) {
    PlyProperty property;
    std::string_view word = scanner.wordOnLine();
    if (word == "list") {
        property.isList = true;
        property.countType = parseType(scanner.wordOnLine(), scanner);
        if (isReal(property.countType)) {
            scanner.fail("the length of a list is a real number");
        }
        word = scanner.wordOnLine();
    }
    property.type = parseType(word, scanner);
    property.name = scanner.wordOnLine();
    if (property.name.empty()) {
        scanner.fail("a property has no name");
    }
    return property;
}

PlyElement parseElement(TextScanner& scanner) {
    PlyElement element;
    element.name = scanner.wordOnLine();
    const std::int64_t count = scanner.integer(scanner.wordOnLine(), "the count of an element");
    if (count < 0) {
        scanner.fail(fmt::format("a count of {}", count));
    }
    element.count = static_cast<std::uint64_t>(count);
    return element;
}

} // namespace

std::size_t sizeOf(PlyType type) {
    switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8:
        return 1;
    case PlyType::Int16:
    case PlyType::UInt16:
        return 2;
    case PlyType::Int32:
    case PlyType::UInt32:
    case PlyType::Float32:
        return 4;
    case PlyType::Float64:
        return 8;
    }
    return 8;
}

bool isReal(PlyType type) {
    return type == PlyType::Float32 || type == PlyType::Float64;
}

std::uint64_t PlyElement::leastBytes(bool text) const {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : properties) {
        bytes += text ? 2 : sizeOf(property.isList ? property.countType : property.type);
    }
    return bytes;
}

PlyHeader readPlyHeader(const std::filesystem::path& file, std::string_view content) {
    TextScanner scanner(file, content, 0);
    if (scanner.wordOnLine() != "ply") {
        scanner.fail("does not start with 'ply'", "check the format and the extension");
    }
    PlyHeader header;
    bool hasFormat = false;
    for (;;) {
        if (!scanner.nextLine()) {
            scanner.fail("the file ends before 'end_header'");
        }
        const std::string_view keyword = scanner.wordOnLine();
        if (keyword == "format") {
            header.format = parseFormat(scanner);
            hasFormat = true;
        } else if (keyword == "element") {
            header.elements.push_back(parseElement(scanner));
        } else if (keyword == "property") {
            if (header.elements.empty()) {
                scanner.fail("a property before the first element");
            }
            header.elements.back().properties.push_back(parseProperty(scanner));
        } else if (keyword == "end_header") {
            break;
        } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
            scanner.fail(fmt::format("'{}' is no keyword of a PLY header", excerpt(keyword)));
        }
    }
    if (!hasFormat) {
        scanner.fail("the header has no 'format'");
    }
    // Binary data starts right after the end of this line, even where they begin with a blank.
    header.lines = scanner.line();
    (void)scanner.restOfLine();
    if (!scanner.nextLine()) {
        scanner.fail("the file ends with its header");
    }
    header.dataOffset = scanner.offset();
    return header;
}

} // namespace celadon::loaders
