#include "app/frame_pattern.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <optional>

namespace celadon::app {
namespace {

struct Field {
    std::size_t begin; ///< of the '%'
    std::size_t end;   ///< past the 'd'
    int digits;
};

/// The field that starts at this '%': %d, or %0Nd with one digit N >= 1.
std::optional<Field> fieldAt(std::string_view text, std::size_t percent) {
    const std::string_view rest = text.substr(percent + 1);
    if (rest.starts_with('d')) {
        return Field{percent, percent + 2, 1};
    }
    if (rest.size() >= 3 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9' && rest[2] == 'd') {
        return Field{percent, percent + 4, rest[1] - '0'};
    }
    return std::nullopt;
}

} // namespace

bool hasFrameField(std::string_view text) {
    for (std::size_t at = text.find('%'); at != std::string_view::npos;
         at = text.find('%', at + 1)) {
        if (fieldAt(text, at)) {
            return true;
        }
    }
    return false;
}

FramePattern::FramePattern(const std::string& option, std::string_view pattern) {
    const auto subject = [&] { return fmt::format("{} '{}'", option, pattern); };
    const std::size_t percent = pattern.find('%');
    if (percent == std::string_view::npos) {
        throw UsageError(subject(), "the name has no place for the frame number", "put %04d in it");
    }
    const std::optional<Field> field = fieldAt(pattern, percent);
    if (!field || pattern.find('%', field->end) != std::string_view::npos) {
        throw UsageError(subject(), "a numbered name holds one %d or %04d and no other %");
    }
    mBefore = pattern.substr(0, field->begin);
    mAfter = pattern.substr(field->end);
    mDigits = field->digits;
}

std::string FramePattern::name(int frame) const {
    return fmt::format("{}{:0{}}{}", mBefore, frame, mDigits, mAfter);
}

} // namespace celadon::app
