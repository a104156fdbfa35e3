#include "ui/background_jobs.h"

#include "renderer/gl/context_glfw.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace celadon::ui {

void BackgroundJobs::Progress::deliver(std::function<void()> result) {
    {
        const std::lock_guard lock(mOwner->mMutex);
        mOwner->mDelivered.push_back(std::move(result));
    }
    mOwner->mNotify();
}

BackgroundJobs::BackgroundJobs(GLFWwindow* window, std::function<void()> notify)
    : mWindow(window), mNotify(std::move(notify)), mThread([this] { run(); }) {}

BackgroundJobs::~BackgroundJobs() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
        mWaiting.clear();
        if (mCurrent) {
            mCurrent->progress->mCancelled = true;
        }
    }
    mWake.notify_all();
    mThread.join();
}

void BackgroundJobs::start(const std::string& title, const std::string& group, Work work) {
    if (!group.empty()) {
        cancel(group);
    }
    {
        const std::lock_guard lock(mMutex);
        auto progress = std::make_shared<Progress>();
        progress->mOwner = this;
        mWaiting.push_back({title, group, std::move(work), std::move(progress)});
    }
    mWake.notify_all();
}

void BackgroundJobs::cancel(const std::string& group) {
    const std::lock_guard lock(mMutex);
    std::erase_if(mWaiting, [&](const Job& job) { return job.group == group; });
    if (mCurrent && mCurrent->group == group) {
        mCurrent->progress->mCancelled = true;
    }
}

void BackgroundJobs::cancelShown() {
    const std::lock_guard lock(mMutex);
    std::erase_if(mWaiting, [](const Job& job) { return !job.title.empty(); });
    if (mCurrent && !mCurrent->title.empty()) {
        mCurrent->progress->mCancelled = true;
    }
}

bool BackgroundJobs::poll() {
    std::vector<std::function<void()>> delivered;
    {
        const std::lock_guard lock(mMutex);
        delivered.swap(mDelivered);
    }
    for (const auto& result : delivered) {
        result();
    }
    return !delivered.empty();
}

bool BackgroundJobs::isIdle() const {
    const std::lock_guard lock(mMutex);
    return mWaiting.empty() && !mCurrent && mDelivered.empty();
}

std::optional<BackgroundJobs::Running> BackgroundJobs::running() const {
    const std::lock_guard lock(mMutex);
    if (!mCurrent || mCurrent->title.empty()) {
        return std::nullopt;
    }
    const auto shown =
        std::ranges::count_if(mWaiting, [](const Job& j) { return !j.title.empty(); });
    return Running{mCurrent->title, mCurrent->progress->fraction(),
                   static_cast<std::size_t>(shown)};
}

std::vector<std::string> BackgroundJobs::takeErrors() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mErrors, {});
}

void BackgroundJobs::run() {
    std::unique_ptr<gl::Context> context;
    std::unique_lock lock(mMutex);
    while (true) {
        mWake.wait(lock, [&] { return mStop || !mWaiting.empty(); });
        if (mStop) {
            break;
        }
        Job job = std::move(mWaiting.front());
        mWaiting.pop_front();
        const Work work = std::exchange(job.work, {});
        const std::shared_ptr<Progress> progress = job.progress;
        mCurrent = std::move(job);
        lock.unlock();
        std::string problem;
        try {
            if (!context) { // only for those who ever have a job
                context = gl::createWindowContext(mWindow);
            }
            work(*context, *progress);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        lock.lock();
        if (!problem.empty() && !progress->mCancelled) {
            mErrors.push_back(problem);
        }
        mCurrent.reset();
        lock.unlock();
        mNotify();
        lock.lock();
    }
    lock.unlock();
}

} // namespace celadon::ui
