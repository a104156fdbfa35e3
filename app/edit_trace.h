#pragma once

#include "ui/editor_options.h"

#include <filesystem>
#include <vector>

/// `celadon edit --trace`: how a long replay went, as a figure of two panels: time of strokes until
/// their light is on screen, and memory, both over the time of the session; and the numbers.
namespace celadon::app {

class EditTrace {
public:
    /// @param file .svg or .png; the numbers go into a .csv beside it @throws UsageError for
    /// another name, OutputError
    explicit EditTrace(std::filesystem::path file);

    void add(const ui::TracePoint& point) { mPoints.push_back(point); }
    /// @throws OutputError
    void write() const;

private:
    std::filesystem::path mFile;
    std::vector<ui::TracePoint> mPoints;
};

} // namespace celadon::app
