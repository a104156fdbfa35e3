#pragma once

#include "renderer/gl/context.h"
#include "subedit/assert.h"

#include <glad/gl.h>

#include <cstdint>
#include <utility>

namespace celadon::gl {

/// The one owner of a GL name: move-only, zero when empty, deletes what it holds when it is
/// replaced or destroyed. `Traits::destroy(GLuint)` says how.
///
/// A name means something in its own context only. When that context is not current the object is
/// not deleted: that would hit a stranger of the same number. It is a programmer's mistake while
/// the context lives (asserted where another context is current), and right when it is gone.
template<class Traits>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : mId(id) {
        CELADON_ASSERT(Context::current() != nullptr);
        mContext = Context::current()->serial();
    }
    ~Handle() { reset(); }

    Handle(Handle&& other) noexcept
        : mId(std::exchange(other.mId, 0)), mContext(std::exchange(other.mContext, 0)) {}
    /// The old object is deleted at once; it may be large.
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            mId = std::exchange(other.mId, 0);
            mContext = std::exchange(other.mContext, 0);
        }
        return *this;
    }

    [[nodiscard]] GLuint id() const {
        CELADON_ASSERT(mId == 0 || isCurrent());
        return mId;
    }
    explicit operator bool() const { return mId != 0; }

    /// Gives the object away.
    [[nodiscard]] GLuint release() {
        mContext = 0;
        return std::exchange(mId, 0);
    }

    void reset() noexcept {
        if (mId == 0) {
            return;
        }
        CELADON_ASSERT(Context::current() == nullptr || isCurrent());
        if (isCurrent()) {
            Traits::destroy(mId);
        }
        mId = 0;
        mContext = 0;
    }

private:
    [[nodiscard]] bool isCurrent() const {
        const Context* const current = Context::current();
        return current != nullptr && current->serial() == mContext;
    }

    GLuint mId = 0;
    std::uint32_t mContext = 0; ///< Context::serial()
};

} // namespace celadon::gl
