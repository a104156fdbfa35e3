#include "renderer/scene/load_uri.h"

#include <cstdint>
#include <system_error>

namespace celadon::loaders {

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// A percent sign that two hex digits do not follow stands for itself.
std::string percentDecoded(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
            hexDigit(text[i + 2]) >= 0) {
            result += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    if (c == '+' || c == '-') {
        return 62;
    }
    return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::string> base64Decoded(std::string_view text) {
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return std::nullopt;
    }
    std::string result;
    result.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64Digit(c);
        if (digit < 0) {
            return std::nullopt;
        }
        bits = ((bits << 6) | static_cast<std::uint32_t>(digit)) & 0xffffffu;
        count += 6;
        if (count >= 8) {
            count -= 8;
            result += static_cast<char>((bits >> count) & 0xffu);
        }
    }
    return result;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return uri.starts_with("data:");
}

std::optional<std::string> decodeDataUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view data = uri.substr(comma + 1);
    return uri.substr(0, comma).ends_with(";base64") ? base64Decoded(data)
                                                     : std::optional(percentDecoded(data));
}

std::optional<std::filesystem::path> resolveUri(const std::filesystem::path& file,
                                                std::string_view uri) {
    const std::string decoded = percentDecoded(uri);
    const std::size_t colon = decoded.find(':');
    const bool hasScheme = colon != std::string::npos && colon < decoded.find('/');
    if (decoded.empty() || hasScheme || decoded[0] == '/' || decoded[0] == '\\' ||
        decoded.find('\0') != std::string::npos) {
        return std::nullopt;
    }
    std::filesystem::path path = file.parent_path() / decoded;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        // Exporters that do not encode may have meant the percent sign itself.
        const std::filesystem::path plain = file.parent_path() / std::string(uri);
        if (std::filesystem::exists(plain, error)) {
            return plain;
        }
    }
    return path;
}

} // namespace celadon::loaders
