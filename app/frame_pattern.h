#pragma once

#include <string>
#include <string_view>

/// File names with a frame number in them: "frame_%04d.png". A pattern is taken apart and checked
/// here and never reaches printf: it comes from the user.
namespace celadon::app {

/// Whether the text has a field such as %d or %04d at all.
[[nodiscard]] bool hasFrameField(std::string_view text);

class FramePattern {
public:
    /// @param option  for messages: "--sequence"
    /// @param pattern holds exactly one %d or %0Nd, N 1..9, and no other %
    /// @throws UsageError
    FramePattern(const std::string& option, std::string_view pattern);

    /// @param frame >= 0; more digits than N widen the name
    [[nodiscard]] std::string name(int frame) const;

private:
    std::string mBefore;
    std::string mAfter;
    int mDigits = 1;
};

} // namespace celadon::app
