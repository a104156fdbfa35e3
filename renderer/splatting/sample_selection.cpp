#include "renderer/splatting/sample_selection.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

namespace celadon {

SampleSelection::SampleSelection(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer,
                                 Scheme scheme)
    : mNothing(gl::Framebuffer::withoutAttachments("nothing", glm::ivec2(1))),
      mNoAttributes("no attributes"),
      mProgram("sample selection", shaders, {"sample_selection.vert", "sample_selection.geom"},
               schemeDefines(scheme)) {
    for (int k = 0; k < buffer.levels(); ++k) {
        const glm::ivec2 size = buffer.positions().size2d(k);
        Level level;
        level.width = size.x;
        level.nodes = size.x * size.y;
        level.indices = gl::Buffer("selected nodes", static_cast<std::size_t>(level.nodes) * 4);
        GLuint id = 0;
        glCreateTransformFeedbacks(1, &id);
        level.feedback = gl::Handle<FeedbackTraits>(id);
        glTransformFeedbackBufferBase(id, 0, level.indices.id());
        glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &id);
        level.written = gl::Handle<QueryTraits>(id);
        level.points = gl::VertexArray("selected nodes");
        level.points.setBuffer(0, level.indices, 4);
        level.points.setAttribute(
            0,
            {.location = 0, .components = 1, .type = GL_INT, .kind = gl::AttributeKind::Integer});
        mLevels.push_back(std::move(level));
    }
}

void SampleSelection::select(const IrradianceBuffer& buffer, const NodeBalls* balls,
                             int splattingLevel) {
    const gl::DebugGroup group("sample selection");
    gl::PassState state = gl::PassState::covering(mNothing);
    state.rasterizerDiscard = true;
    state.apply();
    mProgram.use();
    buffer.positions().bind(0);
    buffer.normals().bind(1);
    buffer.fluxes().bind(2);
    buffer.extents().bind(3);
    buffer.depthRanges().bind(4);
    if (balls != nullptr) {
        balls->radii().bind(5);
    }
    mNoAttributes.bind();
    for (std::size_t k = 0; k < mLevels.size(); ++k) {
        const Level& level = mLevels[k];
        mProgram.set(0, glm::ivec3(static_cast<int>(k), level.width, splattingLevel));
        glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, level.feedback.id());
        glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, level.written.id());
        glBeginTransformFeedback(GL_POINTS);
        glDrawArrays(GL_POINTS, 0, level.nodes);
        glEndTransformFeedback();
        glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    }
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void SampleSelection::draw(int level) const {
    const Level& list = mLevels[static_cast<std::size_t>(level)];
    list.points.bind();
    glDrawTransformFeedback(GL_POINTS, list.feedback.id());
}

std::vector<std::int32_t> SampleSelection::readIndices(int level) const {
    const Level& list = mLevels[static_cast<std::size_t>(level)];
    GLuint count = 0;
    glGetQueryObjectuiv(list.written.id(), GL_QUERY_RESULT, &count);
    return list.indices.read<std::int32_t>(0, count);
}

} // namespace celadon
