#pragma once

#include <cstddef>
#include <memory>
#include <vector>

/// Room for profiles that a stroke sets aside one by one, close together; none moves while others
/// come.
namespace celadon::subedit {

class ProfileArena {
public:
    /// Forgets all that was taken. @param values of a profile
    void reset(std::size_t values) {
        mChunks.clear();
        mValues = values;
        mTaken = 0;
    }

    [[nodiscard]] float* take() {
        const std::size_t chunk = mTaken / kProfilesPerChunk;
        if (chunk == mChunks.size()) {
            mChunks.push_back(std::make_unique_for_overwrite<float[]>(kProfilesPerChunk * mValues));
        }
        return mChunks[chunk].get() + mTaken++ % kProfilesPerChunk * mValues;
    }

private:
    static constexpr std::size_t kProfilesPerChunk = 1024;
    std::vector<std::unique_ptr<float[]>> mChunks;
    std::size_t mValues = 0;
    std::size_t mTaken = 0;
};

} // namespace celadon::subedit
