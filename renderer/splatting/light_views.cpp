#include "renderer/splatting/light_views.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

#include <cmath>

namespace celadon {

namespace {

constexpr std::size_t kViewBytes = 256; ///< uniform blocks may begin at any multiple of this
static_assert(sizeof(blocks::LightBlock) <= kViewBytes);

/// A spot this wide is taken for a point: its own frustum would be stretched too much.
constexpr double kWidestSpotRadians = 1.0;

/// `light_views.comp`
struct LightSource {
    glm::vec4 position;
    glm::vec4 direction;
    glm::vec4 color;
    glm::vec4 cone;
};

bool hasOneView(const Light& light) {
    return light.kind == Light::Kind::Directional ||
           (light.kind == Light::Kind::Spot && light.outerConeRadians < kWidestSpotRadians);
}

LightSource describe(const Light& light, int firstView) {
    const bool narrow = light.kind == Light::Kind::Spot && hasOneView(light);
    LightSource source{};
    source.position = glm::vec4(glm::vec3(light.position), float(int(light.kind)));
    source.direction = glm::vec4(glm::vec3(light.direction),
                                 narrow ? float(std::tan(light.outerConeRadians)) : 1e30f);
    source.color = glm::vec4(glm::vec3(light.color), float(firstView));
    source.cone = glm::vec4(float(std::cos(light.innerConeRadians)),
                            float(std::cos(light.outerConeRadians)), 0.0f, 0.0f);
    return source;
}

/// At least so many bytes; content undefined.
void reserve(gl::Buffer& buffer, const char* label, std::size_t bytes) {
    if (buffer.sizeBytes() < bytes) {
        buffer = gl::Buffer(label, bytes, gl::BufferUse::Update);
    }
}

} // namespace

LightViews::LightViews(const gl::ShaderLibrary& shaders, Target target, int size)
    : mTarget(target),
      mSize(size),
      mMake("light views", shaders, {"light_views.comp"}),
      mUsed("light view in use", shaders, {"light_view_used.vert", "light_view_used.frag"}),
      mNothing(gl::Framebuffer::withoutAttachments("nothing", glm::ivec2(1))),
      mNoAttributes("no attributes") {}

void LightViews::update(std::span<const Light> lights, const GpuWorld& world) {
    const gl::DebugGroup group("light views");
    mSourceOfView.clear();
    mMayBeUnused.clear();
    std::vector<LightSource> sources;
    for (const Light& light : lights) {
        sources.push_back(describe(light, count()));
        const std::size_t views = hasOneView(light) ? 1 : 6;
        mSourceOfView.insert(mSourceOfView.end(), views, static_cast<int>(sources.size()) - 1);
        for (std::size_t face = 0; face < views; ++face) {
            mMayBeUnused.push_back(face > 0);
        }
    }
    if (count() == 0) {
        return;
    }
    reserve(mSources, "lights", sources.size() * sizeof(LightSource));
    reserve(mSourceIndices, "lights of views", mSourceOfView.size() * sizeof(int));
    reserve(mViews, "light views", mSourceOfView.size() * kViewBytes);
    mSources.write(sources);
    mSourceIndices.write(mSourceOfView);
    world.bindBounds();
    mMake.use();
    mMake.set(0, glm::ivec3(count(), mSize, mTarget == Target::Scene ? 1 : 0));
    mSources.bindStorage(0);
    mSourceIndices.bindStorage(1);
    mViews.bindStorage(2);
    mMake.dispatchList(count());
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    askWhichAreUsed();
}

void LightViews::askWhichAreUsed() {
    mQueries.resize(mSourceOfView.size());
    gl::PassState::covering(mNothing).apply();
    mUsed.use();
    mNoAttributes.bind();
    for (int view = 0; view < count(); ++view) {
        gl::Handle<QueryTraits>& query = mQueries[static_cast<std::size_t>(view)];
        if (!mMayBeUnused[static_cast<std::size_t>(view)]) {
            query = {};
            continue;
        }
        if (!query) {
            GLuint id = 0;
            glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &id);
            query = gl::Handle<QueryTraits>(id);
        }
        bind(view);
        glBeginQuery(GL_ANY_SAMPLES_PASSED, query.id());
        glDrawArrays(GL_POINTS, 0, 1);
        glEndQuery(GL_ANY_SAMPLES_PASSED);
    }
}

void LightViews::bind(int view) const {
    mViews.bindUniform(blocks::kLight, static_cast<std::size_t>(view) * kViewBytes,
                       sizeof(blocks::LightBlock));
}

LightViews::Scope LightViews::whereUsed(int view) const {
    return Scope(mQueries[static_cast<std::size_t>(view)].id());
}

blocks::LightBlock LightViews::read(int view) const {
    blocks::LightBlock block;
    mViews.read(static_cast<std::size_t>(view) * kViewBytes,
                std::as_writable_bytes(std::span(&block, 1)));
    return block;
}

} // namespace celadon
