#pragma once

#include "renderer/gl/context.h"
#include "renderer/gl/handle.h"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// How long a stage took.
struct StageTime {
    std::string stage;
    double timeMs = 0.0;
};

/// Measures the stages of a frame. On a GPU by timestamps that the GPU takes as it gets there,
/// which costs no wait until take() is called (see ready()); two timers used in turns never wait.
/// On a software driver, whose queries do not measure, by a clock around finished work: there each
/// border of a stage is a glFinish.
class StageTimer {
public:
    /// @param context current, and outlives the timer
    explicit StageTimer(const Context& context) : mSoftware(context.isSoftware()) {}

    /// Another one for the same driver, without stages.
    [[nodiscard]] StageTimer sibling() const { return StageTimer(mSoftware); }

    /// A stage, from construction to destruction. Stages may nest.
    class [[nodiscard]] Scope {
    public:
        Scope(StageTimer& timer, std::string_view stage)
            : mTimer(timer), mIndex(timer.begin(stage)) {}
        ~Scope() { mTimer.end(mIndex); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        StageTimer& mTimer;
        std::size_t mIndex;
    };
    Scope measure(std::string_view stage) { return Scope(*this, stage); }

    /// Whether take() would return at once. All stages have ended.
    [[nodiscard]] bool ready() const;
    /// Stages since the last call, in the order of their beginnings, one entry per beginning (names
    /// may repeat); waits for the GPU. All stages have ended.
    [[nodiscard]] std::vector<StageTime> take();

private:
    struct QueryTraits {
        static void destroy(GLuint id) { glDeleteQueries(1, &id); }
    };
    explicit StageTimer(bool software) : mSoftware(software) {}

    using Query = Handle<QueryTraits>;
    using Clock = std::chrono::steady_clock;
    struct Stage {
        std::string name;
        Clock::time_point clockBegin, clockEnd;
        Query queryBegin, queryEnd;
        bool ended = false;
    };

    std::size_t begin(std::string_view stage);
    void end(std::size_t index);
    [[nodiscard]] Query stamp();
    [[nodiscard]] double elapsedMs(const Stage& stage) const;

    bool mSoftware;
    std::vector<Stage> mStages;
    std::vector<Query> mFreeQueries;
};

} // namespace celadon::gl
