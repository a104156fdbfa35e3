#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_blocks.h"
#include "renderer/gpu_world.h"
#include "renderer/scene/scene.h"

#include <span>
#include <vector>

/// Frusta from which lights see the scattering surface (DESIGN 3.1), made on the GPU from the
/// bounds that are there, so that a moving shape needs no read-back (light_views.comp has the
/// geometry). Whether a point light needs one frustum or six cube faces is found there as well: it
/// always has six views, and what is drawn and dispatched for those not in use has no effect.
namespace celadon {

class LightViews {
public:
    enum class Target { Scattering, Scene };

    /// @param size N >= 1: texels on a side of what is drawn from the views
    LightViews(const gl::ShaderLibrary& shaders, Target target, int size);

    /// The views of these lights and of the world's bounds as they are then.
    /// @param lights positions in mm
    void update(std::span<const Light> lights, const GpuWorld& world);

    [[nodiscard]] int count() const { return static_cast<int>(mSourceOfView.size()); }
    /// Index of a view's light among those of update().
    [[nodiscard]] std::size_t lightOf(int view) const {
        return static_cast<std::size_t>(mSourceOfView[static_cast<std::size_t>(view)]);
    }
    /// The light block of a view.
    void bind(int view) const;

    /// While it lives, draws, clears of attachments and dispatches count only if the view is in
    /// use.
    class [[nodiscard]] Scope {
    public:
        explicit Scope(GLuint query) : mQuery(query) {
            if (mQuery != 0) {
                glBeginConditionalRender(mQuery, GL_QUERY_WAIT);
            }
        }
        ~Scope() {
            if (mQuery != 0) {
                glEndConditionalRender();
            }
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        GLuint mQuery;
    };
    Scope whereUsed(int view) const;

    /// The light block as the GPU has it; direction.w is 0 where the view is not in use. Waits.
    [[nodiscard]] blocks::LightBlock read(int view) const;
    [[nodiscard]] bool isUsed(int view) const { return read(view).direction.w > 0.0f; }

private:
    struct QueryTraits {
        static void destroy(GLuint id) { glDeleteQueries(1, &id); }
    };

    void askWhichAreUsed();

    Target mTarget;
    int mSize;
    gl::Program mMake, mUsed;
    gl::Framebuffer mNothing; ///< nothing is drawn, but something complete must be bound
    gl::VertexArray mNoAttributes;
    gl::Buffer mSources, mSourceIndices, mViews;
    std::vector<int> mSourceOfView;
    std::vector<bool> mMayBeUnused;                ///< per view
    std::vector<gl::Handle<QueryTraits>> mQueries; ///< per view; empty where always in use
};

} // namespace celadon
