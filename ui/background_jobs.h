#pragma once

#include "renderer/gl/context.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

struct GLFWwindow;

/// Long work with pictures (thumbnails, truth, sequences), one after the other on a thread and a
/// context of its own. The window goes on meanwhile, shows how far it is, and can cancel it.
namespace celadon::ui {

class BackgroundJobs {
public:
    /// What a job and the window say to each other while it runs.
    class Progress {
    public:
        [[nodiscard]] bool isCancelled() const { return mCancelled; }
        [[nodiscard]] const std::atomic<bool>& cancelled() const { return mCancelled; }
        void report(double fraction) { mFraction = fraction; }
        [[nodiscard]] double fraction() const { return mFraction; }
        /// To be called on the window's thread by poll(), in order, also while the job goes on.
        void deliver(std::function<void()> result);

    private:
        friend class BackgroundJobs;
        std::atomic<bool> mCancelled = false;
        std::atomic<double> mFraction = 0.0;
        BackgroundJobs* mOwner = nullptr;
    };
    /// May throw: the message becomes an error of takeErrors().
    using Work = std::function<void(const gl::Context&, Progress&)>;

    struct Running {
        std::string title;
        double fraction = 0.0;
        std::size_t waiting = 0; ///< further visible jobs
    };

    /// @param window hidden, with a context that no thread has current; outlives this
    /// @param notify called on the jobs' thread when there is something for poll()
    BackgroundJobs(GLFWwindow* window, std::function<void()> notify);
    ~BackgroundJobs(); ///< cancels everything
    BackgroundJobs(const BackgroundJobs&) = delete;
    BackgroundJobs& operator=(const BackgroundJobs&) = delete;

    /// @param title shown while it runs; empty: not shown
    /// @param group jobs of one group replace each other: those before are cancelled; empty: none
    void start(const std::string& title, const std::string& group, Work work);
    void cancel(const std::string& group);
    /// Those that are shown.
    void cancelShown();

    /// Calls what jobs delivered. @return whether there was anything
    bool poll();
    [[nodiscard]] bool isIdle() const;
    /// The job under way, if it has a title.
    [[nodiscard]] std::optional<Running> running() const;
    [[nodiscard]] std::vector<std::string> takeErrors();

private:
    struct Job {
        std::string title, group;
        Work work;
        std::shared_ptr<Progress> progress;
    };
    void run();

    GLFWwindow* mWindow;
    std::function<void()> mNotify;
    mutable std::mutex mMutex;
    std::condition_variable mWake;
    bool mStop = false;
    std::deque<Job> mWaiting;
    std::optional<Job> mCurrent; ///< without its work
    std::vector<std::function<void()>> mDelivered;
    std::vector<std::string> mErrors;
    std::thread mThread; ///< last: everything above exists when it starts
};

} // namespace celadon::ui
