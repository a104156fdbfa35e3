#pragma once

#include <tbb/task_group.h>

/// Where long work can end before its end: loops of TBB that were canceled have left out a part, and
/// what comes after them must not take it for the whole. Anywhere else it does nothing.
namespace celadon::subedit {

/// Nobody waits for a result any more.
struct Stopped {};

/// @throws Stopped
inline void stopPoint() {
    if (tbb::is_current_task_group_canceling()) {
        throw Stopped();
    }
}

} // namespace celadon::subedit
