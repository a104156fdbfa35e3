#include "renderer/scene/load_bytes.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace celadon::loaders {

std::string quoted(const std::filesystem::path& file) {
    return fmt::format("'{}'", file.string());
}

std::string readFile(const std::filesystem::path& file, std::uintmax_t maxBytes) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw InputError(quoted(file), "there is no such file", "check the path");
    }
    if (error) {
        throw InputError(quoted(file), "cannot be reached (" + error.message() + ")",
                         "check the path and its permissions");
    }
    if (status.type() == std::filesystem::file_type::directory) {
        throw InputError(quoted(file), "is a folder", "name a file in it");
    }
    if (status.type() != std::filesystem::file_type::regular) {
        throw InputError(quoted(file), "is not a regular file", "copy it to a file first");
    }
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) {
        throw InputError(quoted(file), "its size cannot be read (" + error.message() + ")");
    }
    if (size == 0) {
        throw InputError(quoted(file), "is empty", "export it again");
    }
    if (size > maxBytes) {
        throw InputError(quoted(file),
                         fmt::format("is {:.1f} MB, above the limit of {:.1f} MB",
                                     static_cast<double>(size) * 1e-6,
                                     static_cast<double>(maxBytes) * 1e-6),
                         "split or simplify it");
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw InputError(quoted(file), fmt::format("cannot be opened ({})", std::strerror(errno)),
                         "check its permissions");
    }
    std::string content(static_cast<std::size_t>(size), '\0');
    stream.read(content.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
        throw InputError(quoted(file),
                         fmt::format("only {} of {} bytes could be read", stream.gcount(), size),
                         "check the disk, or try again");
    }
    return content;
}

std::string excerpt(std::string_view text, std::size_t longest) {
    std::string result;
    for (const char c : text.substr(0, longest)) {
        result += (c >= 0x20 && c < 0x7f) ? c : '?';
    }
    if (text.size() > longest) {
        result += "...";
    }
    return result;
}

std::string counted(std::uint64_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

} // namespace celadon::loaders
