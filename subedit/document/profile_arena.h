#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

/// Room for profiles that a stroke sets aside one by one, close together; none moves while others
/// come. What one stroke has taken serves the next: fresh memory costs more than the copy into it.
namespace celadon::subedit {

class ProfileArena {
public:
    /// Forgets all that was taken, and gives back what a usual stroke does not need.
    /// @param values of a profile
    void reset(std::size_t values) {
        mChunks.resize(values == mValues ? std::min(mChunks.size(), kChunksKept) : 0);
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
    static constexpr std::size_t kChunksKept = 16; ///< five dabs of 64 x 64 texels or so
    std::vector<std::unique_ptr<float[]>> mChunks;
    std::size_t mValues = 0;
    std::size_t mTaken = 0;
};

} // namespace celadon::subedit
