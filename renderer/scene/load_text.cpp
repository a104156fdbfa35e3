#include "renderer/scene/load_text.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace celadon::loaders {

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0';
}

std::string_view withoutPlus(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
        word.remove_prefix(1);
    }
    return word;
}

} // namespace

std::optional<double> parseNumber(std::string_view word) {
    word = withoutPlus(word);
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (word.empty() || stop != end || error == std::errc::invalid_argument) {
        return std::nullopt;
    }
    if (error == std::errc::result_out_of_range) {
        value = std::strtod(std::string(word).c_str(), nullptr); // 0 or infinity, by the exponent
    }
    if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
        return std::copysign(std::numeric_limits<double>::infinity(), value);
    }
    return value;
}

std::optional<std::int64_t> parseInteger(std::string_view word) {
    word = withoutPlus(word);
    std::int64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (word.empty() || stop != end || error != std::errc{}) {
        return std::nullopt;
    }
    return value;
}

TextScanner::TextScanner(const std::filesystem::path& file, std::string_view text, char comment)
    : mFile(file), mText(text), mComment(comment) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (mText.starts_with(kByteOrderMark)) {
        mAt = kByteOrderMark.size();
    }
}

std::size_t TextScanner::lineEndLength(std::size_t at) const {
    if (at >= mText.size()) {
        return 0;
    }
    if (mText[at] == '\n') {
        return 1;
    }
    if (mText[at] == '\r') {
        return at + 1 < mText.size() && mText[at + 1] == '\n' ? 2 : 1;
    }
    return 0;
}

bool TextScanner::atLineEnd(std::size_t at) const {
    return at >= mText.size() || mText[at] == '\n' || mText[at] == '\r';
}

void TextScanner::skipBlanks() {
    while (mAt < mText.size()) {
        if (isBlank(mText[mAt])) {
            ++mAt;
        } else if (mText[mAt] == '\\' && lineEndLength(mAt + 1) > 0) {
            mAt += 1 + lineEndLength(mAt + 1);
            ++mLine;
        } else if (mComment != 0 && mText[mAt] == mComment) {
            while (!atLineEnd(mAt)) {
                ++mAt;
            }
            return;
        } else {
            return;
        }
    }
}

std::string_view TextScanner::wordOnLine() {
    skipBlanks();
    const std::size_t start = mAt;
    while (!atLineEnd(mAt) && !isBlank(mText[mAt]) &&
           !(mText[mAt] == '\\' && lineEndLength(mAt + 1) > 0)) {
        ++mAt;
    }
    return mText.substr(start, mAt - start);
}

std::string_view TextScanner::word() {
    for (;;) {
        const std::string_view found = wordOnLine();
        if (!found.empty()) {
            return found;
        }
        if (!nextLine()) {
            return {};
        }
    }
}

bool TextScanner::nextLine() {
    while (!atLineEnd(mAt)) {
        ++mAt;
    }
    if (atEnd()) {
        return false;
    }
    mAt += lineEndLength(mAt);
    ++mLine;
    return !atEnd();
}

std::string_view TextScanner::restOfLine() {
    const std::size_t start = mAt;
    while (!atLineEnd(mAt)) {
        ++mAt;
    }
    return mText.substr(start, mAt - start);
}

float TextScanner::number(std::string_view word, std::string_view what) const {
    if (word.empty()) {
        fail(fmt::format("{} is missing", what));
    }
    const std::optional<double> value = parseNumber(word);
    if (!value) {
        fail(fmt::format("{} is '{}', not a number", what, excerpt(word)));
    }
    if (!std::isfinite(*value)) {
        fail(fmt::format("{} is '{}', not a finite number", what, excerpt(word)),
             "repair the mesh where it was made");
    }
    return static_cast<float>(*value);
}

std::int64_t TextScanner::integer(std::string_view word, std::string_view what) const {
    if (word.empty()) {
        fail(fmt::format("{} is missing", what));
    }
    const std::optional<std::int64_t> value = parseInteger(word);
    if (!value) {
        fail(fmt::format("{} is '{}', not a whole number in range", what, excerpt(word)));
    }
    return *value;
}

std::string TextScanner::whereIs(std::uint64_t line) const {
    return fmt::format("{}, line {}", quoted(mFile), line);
}

void TextScanner::fail(const std::string& reason, const std::string& remedy) const {
    throw InputError(where(), reason, remedy);
}

} // namespace celadon::loaders
