#pragma once

#include <chrono>
#include <optional>
#include <string>

/// An edit that lasts longer than one wants to wait: how far it is, and a way out. Nothing else can
/// be done meanwhile.
namespace celadon::ui {

class LongEdit {
public:
    /// The edit goes on. @param done 0 to 1; below 0: nobody knows
    /// @return whether it is time to draw a frame
    [[nodiscard]] bool tell(const std::string& title, float done);
    /// The edit has ended, one way or the other.
    void finish();

    /// It has lasted long enough to be shown.
    [[nodiscard]] bool isShown() const { return mDrawn.has_value(); }
    [[nodiscard]] bool isGivenUp() const { return mIsGivenUp; }

    void draw(float scale);

private:
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> mBegin, mDrawn;
    std::string mTitle;
    float mDone = -1.0f;
    bool mIsGivenUp = false;
};

} // namespace celadon::ui
