#pragma once

#include <array>

/// Where in a segment its energy reaches a given part, for many segments: eight searches at a time.
namespace celadon::subedit {

class RadiusSearch {
public:
    /// A segment in which P runs from p0 to p0 e^slope, and what to look for.
    struct Segment {
        float index = 0.0f; ///< it reaches from index to index + 1
        float p0 = 0.0f;
        float slope = 0.0f;
        float energy = 0.0f; ///< of all of it: integral of P r dr
        float wanted = 0.0f; ///< from its start
    };

    /// `radius` becomes the radius that is found if that is larger: now or later, at the latest
    /// with finish().
    void add(const Segment& segment, float& radius);
    void finish();

private:
    static constexpr int kLanes = 8;
    struct Lanes {
        std::array<float, kLanes> index{}, p0{}, slope{}, energy{}, part{};
        std::array<float, kLanes> t{}; ///< result, 0 to 1
    };
    static void solve(Lanes& lanes);

    Lanes mLanes;
    std::array<float*, kLanes> mRadii{};
    int mCount = 0;
};

} // namespace celadon::subedit
