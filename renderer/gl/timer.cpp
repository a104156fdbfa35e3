#include "renderer/gl/timer.h"

#include <glad/gl.h>

#include <algorithm>
#include <utility>

namespace celadon::gl {

StageTimer::Query StageTimer::stamp() {
    Query query;
    if (!mFreeQueries.empty()) {
        query = std::move(mFreeQueries.back());
        mFreeQueries.pop_back();
    } else {
        GLuint id = 0;
        glCreateQueries(GL_TIMESTAMP, 1, &id);
        query = Query(id);
    }
    glQueryCounter(query.id(), GL_TIMESTAMP);
    return query;
}

std::size_t StageTimer::begin(std::string_view stage) {
    Stage& added = mStages.emplace_back();
    added.name = stage;
    if (mSoftware) {
        glFinish();
        added.clockBegin = Clock::now();
    } else {
        added.queryBegin = stamp();
    }
    return mStages.size() - 1;
}

void StageTimer::end(std::size_t index) {
    CELADON_ASSERT(index < mStages.size()); // take() must not come within a stage
    Stage& stage = mStages[index];
    if (mSoftware) {
        glFinish();
        stage.clockEnd = Clock::now();
    } else {
        stage.queryEnd = stamp();
    }
    stage.ended = true;
}

bool StageTimer::ready() const {
    // Timestamps need not arrive in order: an outer stage ends after an inner one that began later.
    return std::all_of(mStages.begin(), mStages.end(), [this](const Stage& stage) {
        CELADON_ASSERT(stage.ended);
        if (mSoftware) {
            return true;
        }
        GLint available = GL_FALSE;
        glGetQueryObjectiv(stage.queryEnd.id(), GL_QUERY_RESULT_AVAILABLE, &available);
        return available != GL_FALSE;
    });
}

double StageTimer::elapsedMs(const Stage& stage) const {
    if (mSoftware) {
        return std::chrono::duration<double, std::milli>(stage.clockEnd - stage.clockBegin).count();
    }
    GLuint64 begin = 0;
    GLuint64 end = 0;
    glGetQueryObjectui64v(stage.queryBegin.id(), GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(stage.queryEnd.id(), GL_QUERY_RESULT, &end);
    return end > begin ? static_cast<double>(end - begin) * 1e-6 : 0.0; // nanoseconds
}

std::vector<StageTime> StageTimer::take() {
    std::vector<StageTime> times;
    for (Stage& stage : mStages) {
        CELADON_ASSERT(stage.ended);
        times.push_back({stage.name, elapsedMs(stage)});
        if (!mSoftware) {
            mFreeQueries.push_back(std::move(stage.queryBegin));
            mFreeQueries.push_back(std::move(stage.queryEnd));
        }
    }
    mStages.clear();
    return times;
}

} // namespace celadon::gl
