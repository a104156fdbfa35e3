#include "renderer/scene/atlas_mask.h"

#include <algorithm>
#include <cmath>

namespace celadon::atlas {

Mask::Mask(int width, int height)
    : mWidth(width),
      mHeight(height),
      mStride((width + 63) / 64 + 2),
      mWords(static_cast<std::size_t>(mStride) * height, 0) {}

void Mask::setSpan(int begin, int end, int y) {
    begin = std::max(begin, 0);
    end = std::min(end, mWidth);
    if (begin >= end || y < 0 || y >= mHeight) {
        return;
    }
    const std::uint64_t head = ~std::uint64_t{0} << (begin % 64);
    const std::uint64_t tail = ~std::uint64_t{0} >> (63 - (end - 1) % 64);
    const int first = begin / 64;
    const int last = (end - 1) / 64;
    if (first == last) {
        mWords[index(first, y)] |= head & tail;
        return;
    }
    mWords[index(first, y)] |= head;
    for (int w = first + 1; w < last; ++w) {
        mWords[index(w, y)] = ~std::uint64_t{0};
    }
    mWords[index(last, y)] |= tail;
}

bool Mask::meets(const Mask& other, int x, int y) const {
    for (int row = 0; row < other.mHeight; ++row) {
        for (int w = 0; 64 * w < other.mWidth; ++w) {
            if ((other.word(w, row) & window(x + 64 * w, y + row)) != 0) {
                return true;
            }
        }
    }
    return false;
}

void Mask::add(const Mask& other, int x, int y) {
    const int shift = x % 64;
    for (int row = 0; row < other.mHeight; ++row) {
        for (int w = 0; 64 * w < other.mWidth; ++w) {
            const std::uint64_t bits = other.word(w, row);
            const std::size_t to = index(x / 64 + w, y + row);
            mWords[to] |= bits << shift;
            if (shift != 0) {
                mWords[to + 1] |= bits >> (64 - shift);
            }
        }
    }
}

Mask Mask::dilated(std::span<const int> reach) const {
    const int radius = static_cast<int>(reach.size()) - 1;
    Mask result(mWidth + 2 * radius, mHeight + 2 * radius);
    std::vector<std::uint64_t> wide(result.mStride);
    std::vector<std::uint64_t> wider(result.mStride);
    for (int y = 0; y < mHeight; ++y) {
        // The row, shifted to its place, then widened by one texel to each side at a time.
        std::fill(wide.begin(), wide.end(), 0);
        for (int w = 0; w < mStride; ++w) {
            const std::uint64_t bits = word(w, y);
            const int to = 64 * w + radius;
            if (bits == 0) {
                continue;
            }
            wide[to / 64] |= bits << (to % 64);
            if (to % 64 != 0) {
                wide[to / 64 + 1] |= bits >> (64 - to % 64);
            }
        }
        for (int width = 0; width <= radius; ++width) {
            for (int dy = 0; dy <= radius; ++dy) {
                if (reach[dy] != width) {
                    continue;
                }
                for (const int row : {y + radius - dy, y + radius + dy}) {
                    for (int w = 0; w < result.mStride; ++w) {
                        result.mWords[result.index(w, row)] |= wide[w];
                    }
                }
            }
            for (int w = 0; w < result.mStride; ++w) {
                const std::uint64_t before = w > 0 ? wide[w - 1] >> 63 : 0;
                const std::uint64_t after = w + 1 < result.mStride ? wide[w + 1] << 63 : 0;
                wider[w] = wide[w] | wide[w] << 1 | before | wide[w] >> 1 | after;
            }
            wide.swap(wider);
        }
    }
    return result;
}

namespace {

/// What counts as touched is a little wider than the segment, so that rounding the coordinates to
/// floats later cannot touch more.
constexpr double kPen = 2e-3;

/// Texels that the segment touches, row by row.
void drawSegment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Mask& mask) {
    const Eigen::Vector2d& a = from.y() <= to.y() ? from : to;
    const Eigen::Vector2d& b = from.y() <= to.y() ? to : from;
    const double slope = b.y() > a.y() ? (b.x() - a.x()) / (b.y() - a.y()) : 0.0;
    const int last = static_cast<int>(b.y() + kPen);
    for (int y = static_cast<int>(std::max(0.0, a.y() - kPen)); y <= last; ++y) {
        const double low = std::clamp(y - kPen, a.y(), b.y());
        const double high = std::clamp(y + 1 + kPen, a.y(), b.y());
        const double x0 = low > a.y() ? a.x() + slope * (low - a.y()) : a.x();
        const double x1 = high < b.y() ? a.x() + slope * (high - a.y()) : b.x();
        mask.setSpan(static_cast<int>(std::floor(std::min(x0, x1) - kPen)),
                     static_cast<int>(std::floor(std::max(x0, x1) + kPen)) + 1, y);
    }
}

} // namespace

Mask rasterize(std::span<const std::vector<Eigen::Vector2d>> loops, int width, int height) {
    Mask mask(width, height);
    std::vector<std::vector<double>> crossings(height); // of the borders with row centers
    for (const std::vector<Eigen::Vector2d>& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector2d& a = loop[i];
            const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
            drawSegment(a, b, mask);
            const double low = std::min(a.y(), b.y());
            const double high = std::max(a.y(), b.y());
            for (int y = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
                 y < height && y + 0.5 < high; ++y) {
                crossings[y].push_back(a.x() +
                                       (b.x() - a.x()) * (y + 0.5 - a.y()) / (b.y() - a.y()));
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        std::sort(crossings[y].begin(), crossings[y].end());
        for (std::size_t i = 0; i + 1 < crossings[y].size(); i += 2) {
            mask.setSpan(static_cast<int>(std::floor(crossings[y][i])),
                         static_cast<int>(std::floor(crossings[y][i + 1])) + 1, y);
        }
    }
    return mask;
}

} // namespace celadon::atlas
