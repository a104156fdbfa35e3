#include "subedit/document/edit_progress.h"

#include <tbb/task_group.h>

#include <chrono>
#include <future>

namespace celadon::subedit {

void doTelling(const EditProgress& progress, const std::function<void()>& work) {
    if (!progress) {
        work();
        return;
    }
    constexpr std::chrono::milliseconds kBetween{20};
    tbb::task_group_context context;
    std::future<void> result = std::async(std::launch::async, [&] {
        tbb::task_group group(context);
        group.run_and_wait(work);
    });
    try {
        while (result.wait_for(kBetween) != std::future_status::ready) {
            progress(-1.0f);
        }
    } catch (...) {
        context.cancel_group_execution();
        result.wait();
        throw;
    }
    result.get();
}

} // namespace celadon::subedit
