#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace celadon::atlas {

/// A picture of bits in rows of 64-bit words; bit x % 64 of word x / 64 is texel x.
class Mask {
public:
    Mask() = default;
    Mask(int width, int height);

    [[nodiscard]] int width() const { return mWidth; }
    [[nodiscard]] int height() const { return mHeight; }
    [[nodiscard]] bool at(int x, int y) const { return (word(x / 64, y) >> (x % 64) & 1) != 0; }
    void set(int x, int y) { mWords[index(x / 64, y)] |= std::uint64_t{1} << (x % 64); }
    void setSpan(int begin, int end, int y); ///< [begin, end), clipped to the picture

    /// 64 texels of row y from x on; zeros beyond the width. x >= 0.
    [[nodiscard]] std::uint64_t window(int x, int y) const {
        const std::size_t at = index(x / 64, y);
        const int shift = x % 64;
        return shift == 0 ? mWords[at] : mWords[at] >> shift | mWords[at + 1] << (64 - shift);
    }

    /// Whether any bit of `other`, its texel (0,0) at (x, y), meets one of this; other lies inside.
    [[nodiscard]] bool meets(const Mask& other, int x, int y) const;
    void add(const Mask& other, int x, int y);

    /// With all texels near a set one, and larger by the reach on each side.
    /// @param reach half width of the neighborhood per row distance, from 0 on, not increasing;
    ///              its size - 1 and its first entry are equal
    [[nodiscard]] Mask dilated(std::span<const int> reach) const;

private:
    [[nodiscard]] std::size_t index(int wordX, int y) const {
        return static_cast<std::size_t>(y) * mStride + wordX;
    }
    [[nodiscard]] std::uint64_t word(int wordX, int y) const { return mWords[index(wordX, y)]; }

    int mWidth = 0;
    int mHeight = 0;
    int mStride = 0; ///< words per row, two spare ones included
    std::vector<std::uint64_t> mWords;
};

/// Every texel that the region inside the closed loops (even-odd) touches, if only at a corner.
/// @param loops in texels, all coordinates inside the picture
[[nodiscard]] Mask rasterize(std::span<const std::vector<Eigen::Vector2d>> loops, int width,
                             int height);

} // namespace celadon::atlas
