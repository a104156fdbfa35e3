#include "subedit/edit/apply_operator.h"

#include "subedit/assert.h"
#include "subedit/errors.h"
#include "subedit/fast_exp.h"
#include "subedit/fast_log.h"
#include "subedit/multiversion.h"
#include "subedit/paint/stroke_mask.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

constexpr float kRadiusEnergy = 0.95f; ///< of R_P
constexpr glm::vec3 kLuminance{0.2126f, 0.7152f, 0.0722f};

/// Turns by `angle` about the unit vector `axis` (Rodrigues).
glm::mat3 turnAbout(const glm::vec3& axis, float sine, float cosine) {
    const glm::mat3 cross(glm::vec3(0.0f, axis.z, -axis.y), glm::vec3(-axis.z, 0.0f, axis.x),
                          glm::vec3(axis.y, -axis.x, 0.0f));
    return glm::mat3(1.0f) + sine * cross + (1.0f - cosine) * (cross * cross);
}

/// ln((1 - a) e^p + a e^q), both terms in units of the larger so that neither is lost: one is 1
/// then, and needs no exponential.
CELADON_MULTIVERSION void mixLogs(float* __restrict p, const float* __restrict q, float a,
                                  int count) {
    for (int i = 0; i < count; ++i) {
        const float ahead = q[i] - p[i];
        const float smaller = fastExp(-std::abs(ahead));
        const bool isLarger = ahead > 0.0f;
        const float top = isLarger ? q[i] : p[i];
        const float atTop = isLarger ? a : 1.0f - a;
        p[i] = top + fastLog(atTop + (1.0f - atTop) * smaller);
    }
}

/// The smallest turn that brings one unit vector onto another.
glm::mat3 turnOnto(const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 axis = glm::cross(from, to);
    const float sine = glm::length(axis);
    const float cosine = glm::dot(from, to);
    if (sine > 1e-6f) {
        return turnAbout(axis / sine, sine, cosine);
    }
    if (cosine > 0.0f) {
        return glm::mat3(1.0f);
    }
    // Opposite: half a turn about any axis across.
    const glm::vec3 other =
        std::abs(from.x) < 0.6f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    return turnAbout(glm::normalize(glm::cross(from, other)), 0.0f, -1.0f);
}

} // namespace

/// One texel: the operator's meaning.
struct OperatorVisitor {
    const PreparedOperator& prepared;
    ProfileEditor& editor;
    ProfileEditor& target;
    Surface::Texel texel; ///< covered
    float weight;
    TexelOutcome& outcome;
    std::vector<float>& base; ///< working memory

    void operator()(const ScaleAlbedo& op) const {
        setAlbedo(editor.albedo() * (1.0f + weight * (op.factor - 1.0f)));
    }

    void operator()(const SetAlbedo& op) const {
        setAlbedo(editor.albedo() + weight * (op.albedo - editor.albedo()));
    }

    void operator()(const Tint& op) const {
        const float luminance = glm::dot(editor.albedo(), kLuminance);
        const glm::vec3 tinted = op.color * (luminance / glm::dot(op.color, kLuminance));
        setAlbedo(editor.albedo() + weight * op.amount * (tinted - editor.albedo()));
    }

    void operator()(const ScaleRange&) const {
        const glm::vec3 log = weight * prepared.mLogFactor;
        scaleRange({fastExp(log.x), fastExp(log.y), fastExp(log.z)});
    }

    void operator()(const SetRange& op) const {
        glm::vec3 scale(1.0f);
        for (int c = 0; c < 3; ++c) {
            const float radius = editor.radiusMm(c, kRadiusEnergy);
            scale[c] = radius > 0.0f ? std::pow(op.radiusMm[c] / radius, weight) : 1.0f;
        }
        scaleRange(scale);
    }

    void operator()(const SetShape& op) const {
        const ProfileLayout& layout = prepared.mLayout;
        const float curveSpacing = op.curve.maxRadiusMm / static_cast<float>(op.curve.segments);
        const glm::vec3 albedo = editor.albedo();
        glm::vec3 radius(0.0f);
        glm::vec3 scale(1.0f);
        glm::vec3 amount(0.0f);
        for (int c = 0; c < 3; ++c) {
            radius[c] = editor.radiusMm(c, kRadiusEnergy);
            const float curveRadius = prepared.mCurveRadiusMm[c];
            if (radius[c] > 0.0f && curveRadius > 0.0f) {
                scale[c] = radius[c] / curveRadius;
                amount[c] = weight;
                outcome.neededRadiusMm =
                    std::max(outcome.neededRadiusMm, scale[c] * prepared.mCurveHeldRadiusMm[c]);
            }
        }
        resampleChannels(op.curve.logProfile.data(), op.curve.segments, curveSpacing, scale,
                         target.values(), layout.segments, layout.spacingMm());
        // A common factor of the curve does not matter: the albedo is restored below.
        for (std::size_t i = 0; i < layout.values(); ++i) {
            float& value = editor.values()[i];
            value += amount[static_cast<int>(i % 3)] * (target.values()[i] - value);
        }
        editor.measure();
        // Interpolation and knots move R_P a little: back to where it was.
        glm::vec3 back(1.0f);
        for (int c = 0; c < 3; ++c) {
            const float moved = editor.radiusMm(c, kRadiusEnergy);
            back[c] = radius[c] > 0.0f && moved > 0.0f ? radius[c] / moved : 1.0f;
        }
        editor.scaleRange(back);
        setAlbedo(albedo);
        limitNeed();
    }

    void operator()(const Mix& op) const {
        mix(prepared.mFirst.data(), prepared.mFirstAlbedo, weight * op.amount);
    }

    void operator()(const Gradient& op) const {
        const glm::vec3 along = op.toMm - op.fromMm;
        const float t =
            std::clamp(glm::dot(prepared.mSurface.positionMm(texel) - op.fromMm, along) /
                           glm::dot(along, along),
                       0.0f, 1.0f);
        for (std::size_t i = 0; i < prepared.mFirst.size(); ++i) {
            target.values()[i] =
                prepared.mFirst[i] + t * (prepared.mSecond[i] - prepared.mFirst[i]);
        }
        target.measure();
        mix(target.result(), target.albedo(), weight);
    }

    void operator()(const Heterogeneity& op) const {
        prepared.mMean->evaluate(texel, target.values());
        const float amount = weight * op.amount;
        for (std::size_t i = 0; i < prepared.mLayout.values(); ++i) {
            float& value = editor.values()[i];
            value = std::max(value + amount * (value - target.values()[i]), kLogProfileFloor);
        }
        editor.measure();
        clampAlbedo();
    }

    void operator()(const Clone&) const {
        if (const auto from = prepared.placedOnto(texel)) {
            target.load(prepared.mSource.profile(*from));
            mix(target.result(), target.albedo(), weight);
        }
    }

    void operator()(const TransferPattern& op) const {
        const auto from = prepared.placedOnto(texel);
        if (!from) {
            return;
        }
        prepared.mMean->evaluate(*from, target.values());
        const std::size_t count = prepared.mLayout.values();
        const float* pattern = prepared.mSource.profile(*from);
        for (std::size_t i = 0; i < count; ++i) {
            target.values()[i] = op.strength * (pattern[i] - target.values()[i]);
        }
        base.resize(count);
        prepared.mMean->evaluate(texel, base.data());
        for (std::size_t i = 0; i < count; ++i) {
            float& value = editor.values()[i];
            value += weight * (base[i] + target.values()[i] - value);
            value = std::max(value, kLogProfileFloor);
        }
        editor.measure();
        clampAlbedo();
    }

    /// P becomes (1 - a) P + a Q. The sum is taken at the knots; the albedo is what it should be.
    void mix(const float* q, const glm::vec3& qAlbedo, float a) const {
        outcome.neededRadiusMm = prepared.mHeldRadiusMm;
        limitNeed();
        const glm::vec3 albedo = editor.albedo() + a * (qAlbedo - editor.albedo());
        float* values = editor.values();
        const std::size_t count = prepared.mLayout.values();
        if (a >= 1.0f) {
            std::copy_n(q, count, values);
            editor.measure();
            clampAlbedo(); // and not a bit is changed otherwise
            return;
        }
        mixLogs(values, q, a, static_cast<int>(count));
        editor.measure();
        setAlbedo(albedo);
    }

    void scaleRange(glm::vec3 scale) const {
        const glm::vec3 albedo = editor.albedo();
        for (int c = 0; c < 3; ++c) {
            // Only a profile whose bound leaves r_s can need more than there is.
            if (scale[c] > 1.0f &&
                scale[c] * editor.radiusBoundMm(c, kHeldEnergy) > prepared.mLayout.maxRadiusMm) {
                const float held = editor.radiusMm(c, kHeldEnergy);
                if (scale[c] * held > prepared.mLargestRadiusMm) {
                    outcome.rangeClamped = true;
                    scale[c] = std::max(prepared.mLargestRadiusMm / held, 1.0f);
                }
                outcome.neededRadiusMm = std::max(outcome.neededRadiusMm, scale[c] * held);
            }
        }
        editor.scaleRange(scale);
        setAlbedo(albedo);
    }

    /// The result is cut at the largest r_s: that much, and said.
    void limitNeed() const {
        if (outcome.neededRadiusMm > prepared.mLargestRadiusMm) {
            outcome.neededRadiusMm = prepared.mLargestRadiusMm;
            outcome.rangeClamped = true;
        }
    }

    void setAlbedo(const glm::vec3& albedo) const {
        for (int c = 0; c < 3; ++c) {
            if (albedo[c] > kLargestAlbedo) {
                outcome.energyClamped = outcome.energyClamped || albedo[c] > 1.0f;
            }
        }
        editor.setAlbedo(glm::clamp(albedo, 0.0f, kLargestAlbedo));
    }

    void clampAlbedo() const {
        for (int c = 0; c < 3; ++c) {
            if (editor.albedo()[c] > kLargestAlbedo) {
                outcome.energyClamped = outcome.energyClamped || editor.albedo()[c] > 1.0f;
                editor.setAlbedo(c, kLargestAlbedo);
            }
        }
    }
};

PreparedOperator::PreparedOperator(const EditOperator& op, const ProfileLayout& layout,
                                   float largestRadiusMm, const Surface& surface,
                                   const ProfileSource& source)
    : mOperator(op),
      mLayout(layout),
      mLargestRadiusMm(largestRadiusMm),
      mSurface(surface),
      mSource(source) {
    CELADON_ASSERT(largestRadiusMm >= layout.maxRadiusMm);
    if (const auto* mix = std::get_if<Mix>(&op)) {
        mFirst = resampleProfile(mix->profile, layout);
        mHeldRadiusMm = heldRadiusMm(mix->profile);
    } else if (const auto* gradient = std::get_if<Gradient>(&op)) {
        mFirst = resampleProfile(gradient->from, layout);
        mSecond = resampleProfile(gradient->to, layout);
        mHeldRadiusMm = std::max(heldRadiusMm(gradient->from), heldRadiusMm(gradient->to));
    } else if (const auto* range = std::get_if<ScaleRange>(&op)) {
        for (int c = 0; c < 3; ++c) {
            mLogFactor[c] = fastLog(range->factor[c]);
        }
    } else if (const auto* shape = std::get_if<SetShape>(&op)) {
        ProfileEditor editor({shape->curve.segments, shape->curve.maxRadiusMm});
        editor.load(shape->curve.logProfile.data());
        for (int c = 0; c < 3; ++c) {
            mCurveRadiusMm[c] = editor.radiusMm(c, kRadiusEnergy);
            mCurveHeldRadiusMm[c] = editor.radiusMm(c, kHeldEnergy);
        }
    }
    if (const auto* heterogeneity = std::get_if<Heterogeneity>(&op)) {
        mMean = std::make_unique<LocalMean>(surface, layout, heterogeneity->radiusMm, source);
    } else if (const auto* clone = std::get_if<Clone>(&op)) {
        place(clone->placement, operatorName(op));
    } else if (const auto* transfer = std::get_if<TransferPattern>(&op)) {
        place(transfer->placement, operatorName(op));
        mMean = std::make_unique<LocalMean>(surface, layout, transfer->radiusMm, source);
    }
    if (!mFirst.empty()) {
        ProfileEditor editor(layout);
        editor.load(mFirst.data());
        mFirstAlbedo = editor.albedo();
    }
}

void PreparedOperator::place(const Placement& placement, std::string_view name) {
    const float reach = 4.0f * mSurface.texelSizeMm();
    const auto resolve = [&](const StrokePoint& point, const char* end) {
        auto resolved = StrokeMask::resolve(mSurface, point, reach);
        if (!resolved ||
            !mSurface.nearest(resolved->positionMm, resolved->normal, reach).has_value()) {
            throw InputError(fmt::format("operator '{}'", name),
                             fmt::format("the place that '{}' names is not on the surface", end));
        }
        return *resolved;
    };
    const StrokePoint from = resolve(placement.from, "from");
    const StrokePoint to = resolve(placement.to, "to");
    const float angle = glm::radians(placement.angleDegrees);
    mFrom = from.positionMm;
    mTo = to.positionMm;
    // What is laid down turned by the angle is looked up turned back.
    mTurn = turnAbout(from.normal, -std::sin(angle), std::cos(angle)) *
            turnOnto(to.normal, from.normal);
}

std::optional<Surface::Texel> PreparedOperator::placedOnto(Surface::Texel texel) const {
    const glm::vec3 offset = mSurface.positionMm(texel) - mTo;
    // Both places are curved, each in its own way: farther out they may lie farther apart.
    const float reach = std::max(3.0f * mSurface.texelSizeMm(), 0.5f * glm::length(offset));
    return mSurface.nearest(mFrom + mTurn * offset, mTurn * mSurface.normal(texel), reach);
}

PreparedOperator::Worker::Worker(const PreparedOperator& prepared)
    : mPrepared(prepared), mEditor(prepared.mLayout), mTarget(prepared.mLayout) {}

TexelOutcome PreparedOperator::Worker::evaluate(Surface::Texel texel, const float* before,
                                                float weight, float* after) {
    TexelOutcome outcome;
    const std::size_t count = mPrepared.mLayout.values();
    // Background repeats the texel that it is the gutter of; operators that act on a texel alone
    // act on what is there, the others look at places, which only that texel has.
    const Surface::Texel source = mPrepared.mSurface.sourceOf(texel);
    const bool needsPlace =
        !isLocal(mPrepared.mOperator) || std::holds_alternative<Gradient>(mPrepared.mOperator);
    if (weight <= 0.0f || (needsPlace && source == Surface::kNone)) {
        std::copy_n(before, count, after);
        return outcome;
    }
    const bool repeats = source != texel && !isLocal(mPrepared.mOperator);
    mEditor.load(repeats ? mPrepared.mSource.profile(source) : before);
    std::visit(OperatorVisitor{mPrepared, mEditor, mTarget, source, weight, outcome, mBase},
               mPrepared.mOperator);
    std::copy_n(mEditor.result(), count, after);
    return outcome;
}

} // namespace celadon::subedit
