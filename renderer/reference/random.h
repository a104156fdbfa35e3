#pragma once

#include <cstdint>

namespace celadon {

/// SplitMix64 (Steele, Lea, Flood 2014): a good generator whose state is one number, so that each
/// triangle or batch can have its own and the order of work does not matter.
class Random {
public:
    Random(std::uint64_t seed, std::uint64_t stream)
        : mState(mix(seed * 0x9e3779b97f4a7c15ULL + 1) ^ mix(stream + 0x632be59bd9b4e019ULL)) {}

    /// In [0, 1).
    double uniform() {
        mState += 0x9e3779b97f4a7c15ULL;
        return static_cast<double>(mix(mState) >> 11) * 0x1p-53;
    }

private:
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    std::uint64_t mState;
};

} // namespace celadon
