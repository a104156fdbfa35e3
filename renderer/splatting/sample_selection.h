#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/handle.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/node_balls.h"
#include "renderer/splatting/splatting_settings.h"

#include <cstdint>
#include <vector>

/// Step 2 (Chen et al. 2012, eqs. 10 and 11; DESIGN 3.2): which nodes of the irradiance buffer are
/// samples. Runs in the vertex shader; transform feedback keeps a compact list per level, in the
/// order of the nodes, and draws from it need no read-back.
namespace celadon {

class SampleSelection {
public:
    /// The paper's scheme selects each sample once for all rings. The hierarchical scheme selects,
    /// for each splatting level, the nodes that have weight somewhere in its ring.
    static constexpr int kAnyRing = -1;

    SampleSelection(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer,
                    Scheme scheme);

    /// After buildMips, NodeProfiles::build and NodeBalls::build. The frame, light and solve blocks
    /// are bound. Replaces the last selection.
    /// @param balls hierarchical only @param splattingLevel hierarchical only, or kAnyRing
    void select(const IrradianceBuffer& buffer, const NodeBalls* balls, int splattingLevel);

    /// Draws a point per selected node of a level, attribute 0: its index y * width + x.
    void draw(int level) const;

    /// Indices of the selected nodes of a level. Waits for the GPU.
    [[nodiscard]] std::vector<std::int32_t> readIndices(int level) const;

private:
    struct FeedbackTraits {
        static void destroy(GLuint id) { glDeleteTransformFeedbacks(1, &id); }
    };
    struct QueryTraits {
        static void destroy(GLuint id) { glDeleteQueries(1, &id); }
    };
    struct Level {
        gl::Buffer indices;
        gl::Handle<FeedbackTraits> feedback;
        gl::Handle<QueryTraits> written;
        gl::VertexArray points;
        int width = 0;
        int nodes = 0;
    };
    std::vector<Level> mLevels;
    gl::Framebuffer mNothing; ///< nothing is drawn, but something complete must be bound
    gl::VertexArray mNoAttributes;
    gl::Program mProgram;
};

} // namespace celadon
