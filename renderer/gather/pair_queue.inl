// Pairs that wait until a whole vector of them can be computed, for pair_kernel.inl.

namespace celadon::gather {
namespace {

/// Rows of kColumns numbers and the indices of a pair. Whole vectors are written and read, so there
/// is room for one behind the last.
template<int kColumns>
struct PairQueue {
    static constexpr int kFull = 256; ///< from here on it should be drained
    static constexpr int kRoom = kFull + kTilePixels + L::kCount;

    alignas(64) float columns[kColumns][kRoom];
    alignas(64) std::int32_t pixel[kRoom];
    alignas(64) std::int32_t profile[kRoom];
    int size = 0;

    [[nodiscard]] Float at(int column, int i) const { return L::load(columns[column] + i); }
    [[nodiscard]] PairIndices indices(int i) const { return {pixel + i, profile + i}; }

    void append(Mask where, const Float (&values)[kColumns], const PairIndices& indices) {
        const L::Compression compression(where);
        for (int i = 0; i < kColumns; ++i) {
            compression.store(columns[i] + size, values[i]);
        }
        compression.store(pixel + size, L::load(indices.pixel));
        compression.store(profile + size, L::load(indices.profile));
        size += __builtin_popcount(L::bits(where));
    }

    /// Calls `compute` for the first pair of each whole vector and keeps the rest; with `all`, the
    /// last vector is filled up with pairs that bring nothing.
    template<class Compute>
    void drain(bool all, const Compute& compute) {
        if (all) {
            for (int i = size; i < size + L::kCount; ++i) {
                for (auto& column : columns) {
                    column[i] = 0.0f;
                }
                pixel[i] = profile[i] = 0;
            }
            size = (size + L::kCount - 1) / L::kCount * L::kCount;
        }
        int i = 0;
        for (; i + L::kCount <= size; i += L::kCount) {
            compute(i);
        }
        for (auto& column : columns) {
            L::store(column, L::load(column + i));
        }
        L::store(pixel, L::load(pixel + i));
        L::store(profile, L::load(profile + i));
        size -= i;
    }
};

} // namespace
} // namespace celadon::gather
