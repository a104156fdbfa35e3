#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// Words, numbers and line numbers of a text model file, in memory.
namespace celadon::loaders {

/// A number, whole and finite as float; a leading plus is allowed.
/// @return nothing when the word is no number; infinity when it is beyond the range of float
[[nodiscard]] std::optional<double> parseNumber(std::string_view word);

/// A whole number; nothing when the word is none or beyond 64 bits.
[[nodiscard]] std::optional<std::int64_t> parseInteger(std::string_view word);

/// Walks over words separated by blanks; knows its line. A backslash before a line's end joins it
/// with the next; lines end with LF, CRLF or CR.
class TextScanner {
public:
    /// @param comment a character that hides the rest of its line; 0: none
    TextScanner(const std::filesystem::path& file, std::string_view text, char comment);

    /// The next word on this line, empty at its end.
    [[nodiscard]] std::string_view wordOnLine();

    /// The next word on this or a later line, empty at the end of the file.
    [[nodiscard]] std::string_view word();

    /// Goes to the start of the next line. False at the end of the file.
    bool nextLine();

    /// The rest of this line, without its end.
    [[nodiscard]] std::string_view restOfLine();

    [[nodiscard]] std::uint64_t line() const { return mLine; }
    [[nodiscard]] std::size_t offset() const { return mAt; }
    [[nodiscard]] std::size_t remaining() const { return mText.size() - mAt; }
    [[nodiscard]] bool atEnd() const { return mAt >= mText.size(); }

    /// The word as a number that a float can hold. `what` names it in the message: "x of a vertex".
    /// @throws InputError with the line: missing, not a number, not finite
    [[nodiscard]] float number(std::string_view word, std::string_view what) const;

    /// @throws InputError with the line
    [[nodiscard]] std::int64_t integer(std::string_view word, std::string_view what) const;

    [[noreturn]] void fail(const std::string& reason,
                           const std::string& remedy = "export the model again") const;
    [[nodiscard]] std::string where() const { return whereIs(mLine); }
    [[nodiscard]] std::string whereIs(std::uint64_t line) const;

private:
    const std::filesystem::path& mFile;
    std::string_view mText;
    std::size_t mAt = 0;
    std::uint64_t mLine = 1;
    char mComment;

    void skipBlanks();
    [[nodiscard]] bool atLineEnd(std::size_t at) const;
    [[nodiscard]] std::size_t lineEndLength(std::size_t at) const;
};

} // namespace celadon::loaders
