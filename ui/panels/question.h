#pragma once

#include <functional>
#include <string>
#include <vector>

/// A question that must be answered before anything else: unsaved changes, recovery.
namespace celadon::ui {

class Question {
public:
    struct Answer {
        std::string label;
        std::function<void()> act; ///< may be empty: nothing happens
    };

    /// @param answers the last one is what Escape means; the first is the proposed one
    void ask(const std::string& title, const std::string& text, std::vector<Answer> answers);
    [[nodiscard]] bool isOpen() const { return !mAnswers.empty(); }
    void draw(float scale);

private:
    std::string mTitle;
    std::string mText;
    std::vector<Answer> mAnswers;
    bool mAppears = false;
};

} // namespace celadon::ui
