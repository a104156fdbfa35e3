#pragma once

#include "subedit/edit/edit_operator.h"
#include "subedit/edit/local_mean.h"
#include "subedit/edit/profile_editor.h"
#include "subedit/edit/profile_source.h"

#include <glm/mat3x3.hpp>

#include <memory>
#include <optional>
#include <vector>

/// An operator made ready for the texels of one map: from a texel's profile before and a weight to
/// its profile after.
namespace celadon::subedit {

/// What a texel's edit ran into.
struct TexelOutcome {
    bool energyClamped = false; ///< the albedo would have been above 1 in a channel
    bool rangeClamped = false;  ///< the range would have needed more than the largest r_s allowed
    /// The r_s that the result needs. If above the layout's, the result is cut: grow the map
    /// (grow_radius.h), then do it again.
    float neededRadiusMm = 0.0f;
};

class PreparedOperator {
public:
    /// @param largestRadiusMm the r_s that the map may grow to; >= layout.maxRadiusMm
    /// @param surface, source must outlive this; `source` gives the profiles before the edit
    /// @throws InputError if a place that the operator names is not on the surface
    PreparedOperator(const EditOperator& op, const ProfileLayout& layout, float largestRadiusMm,
                     const Surface& surface, const ProfileSource& source);

    /// Of one thread. Holds the working memory, so that texels allocate nothing.
    class Worker {
    public:
        explicit Worker(const PreparedOperator& prepared);
        /// @param before, after knots x 3 values of ln P; may be the same
        /// @param weight in [0, 1]; 0 copies
        TexelOutcome evaluate(Surface::Texel texel, const float* before, float weight,
                              float* after);

    private:
        const PreparedOperator& mPrepared;
        ProfileEditor mEditor;
        ProfileEditor mTarget;
        std::vector<float> mBase;
    };

private:
    friend struct OperatorVisitor;

    EditOperator mOperator;
    ProfileLayout mLayout;
    float mLargestRadiusMm;
    const Surface& mSurface;
    const ProfileSource& mSource;
    std::vector<float> mFirst;  ///< the operator's profile, or curve, at the layout's knots
    std::vector<float> mSecond; ///< the other end of a gradient
    glm::vec3 mLogFactor{0.0f}; ///< of ScaleRange
    glm::vec3 mFirstAlbedo{0.0f};
    float mHeldRadiusMm = 0.0f;         ///< of the operator's profiles
    glm::vec3 mCurveRadiusMm{0.0f};     ///< of a shape: R_P of its channels
    glm::vec3 mCurveHeldRadiusMm{0.0f}; ///< and what holds kHeldEnergy
    std::unique_ptr<LocalMean> mMean;

    /// A placement, resolved: a point x lies where mFrom + mTurn (x - mTo) was.
    void place(const Placement& placement, std::string_view name);
    [[nodiscard]] std::optional<Surface::Texel> placedOnto(Surface::Texel texel) const;
    glm::vec3 mFrom{0.0f};
    glm::vec3 mTo{0.0f};
    glm::mat3 mTurn{1.0f};
};

} // namespace celadon::subedit
