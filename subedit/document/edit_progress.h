#pragma once

#include <functional>

/// Long edits tell how far they are, and can be given up on the way.
namespace celadon::subedit {

/// Called on the thread that executes an edit, now and then while it lasts, with how much of it is
/// done: 0 to 1, or below 0 where nobody knows. It may read the document, but not change it. What
/// it throws ends the edit and leaves the document as it was.
using EditProgress = std::function<void(float done)>;

/// Does the work; with a progress on another thread, so that this one can tell. When the progress
/// throws, the work is left at its next stopPoint() (subedit/stop_point.h), or its result unused.
void doTelling(const EditProgress& progress, const std::function<void()>& work);

} // namespace celadon::subedit
