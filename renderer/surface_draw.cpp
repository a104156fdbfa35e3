#include "renderer/surface_draw.h"

#include "subedit/assert.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <span>

namespace celadon {

namespace {

/// Uniform locations and texture unit of include/seen_surface.glsl.
enum Location { kMeshPlace = 10, kToClip, kPictureSize };
constexpr GLuint kTrianglesUnit = 15;

template<class Block>
Block readBoundBlock(GLuint binding) {
    GLint buffer = 0;
    GLint64 offset = 0;
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, binding, &buffer);
    glGetInteger64i_v(GL_UNIFORM_BUFFER_START, binding, &offset);
    Block block;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(static_cast<GLuint>(buffer), static_cast<GLintptr>(offset),
                            sizeof(Block), &block);
    return block;
}

/// Orthographic: depth from 1 to 0 over the scene, as in surface.vert.
glm::vec4 orthographicDepth(const blocks::FrameBlock& frame, const glm::vec4& scene) {
    const float scale = 0.5f / std::max(1.001f * scene.w, 1e-6f);
    const glm::vec3 forward(frame.forward);
    return glm::vec4(-scale * forward, 0.5f + scale * glm::dot(forward, glm::vec3(scene)));
}

} // namespace

std::optional<RasterView> boundRasterView(const GpuWorld& world, SeenFrom eye, glm::ivec2 size) {
    RasterView view;
    view.size = size;
    if (eye == SeenFrom::Light) {
        const auto light = readBoundBlock<blocks::LightBlock>(blocks::kLight);
        if (light.direction.w == 0.0f) {
            return std::nullopt;
        }
        view.toClip = light.viewProjection;
        return view;
    }
    const auto frame = readBoundBlock<blocks::FrameBlock>(blocks::kFrame);
    view.toClip = frame.viewProjection;
    if (frame.eye.w < 0.5f) {
        view.toClip = glm::row(view.toClip, 2, orthographicDepth(frame, world.readBounds().scene));
    }
    return view;
}

SurfaceDraw::SurfaceDraw(std::string_view label, const gl::ShaderLibrary& shaders, SeenFrom eye,
                         Shows shows, std::string_view fragmentShader,
                         std::vector<gl::ShaderDefine> defines)
    : mEye(eye), mShows(shows), mNoAttributes("no attributes") {
    if (eye == SeenFrom::Camera) {
        defines.push_back({"CAMERA", "1"});
    }
    const bool isSeen = shaders.isDefined("VISIBLE_TRIANGLES");
    if (!isSeen || shows != Shows::Depth) { // the processor's depths need no shader
        mProgram = gl::Program(
            label, shaders, {isSeen ? "fullscreen.vert" : "surface.vert", fragmentShader}, defines);
    }
}

const TriangleRaster* SurfaceDraw::draw(const GpuWorld& world, const gl::PassState& target,
                                        gl::Texture& depth, std::span<const glm::vec2> morePlaces) {
    if (world.rasterizer() == Rasterizer::Processor) {
        return drawByProcessor(world, target, depth, morePlaces);
    }
    drawByDriver(world, target);
    return nullptr;
}

void SurfaceDraw::drawByDriver(const GpuWorld& world, const gl::PassState& target) const {
    gl::PassState state = target;
    state.depthTest = gl::DepthTest::Greater;
    state.depthWrite = true;
    state.apply();
    world.draw(mProgram, mShows == Shows::Looks);
}

const TriangleRaster* SurfaceDraw::drawByProcessor(const GpuWorld& world,
                                                   const gl::PassState& target, gl::Texture& depth,
                                                   std::span<const glm::vec2> morePlaces) {
    CELADON_ASSERT(target.viewport.x == 0 && target.viewport.y == 0);
    const glm::ivec2 size(target.viewport.z, target.viewport.w);
    std::optional<RasterView> view = boundRasterView(world, mEye, size);
    if (!view) {
        return nullptr;
    }
    view->clampsDepth = target.depthClamp;
    std::vector<glm::vec2> places(1, glm::vec2(0.0f));
    places.insert(places.end(), morePlaces.begin(), morePlaces.end());
    if (!morePlaces.empty()) {
        view->places = places;
    }
    const TriangleRaster& seen = world.rasterize(*view);
    depth.uploadRegion(0, glm::ivec3(0), glm::ivec3(size, 1), seen.depths().first(seen.pixels()));
    if (mShows != Shows::Depth) {
        shade(world, seen, target, *view);
    }
    return &seen;
}

void SurfaceDraw::shade(const GpuWorld& world, const TriangleRaster& seen, gl::PassState state,
                        const RasterView& view) {
    if (!mTriangles || mTriangles.size2d() != view.size) {
        mTriangles = gl::Texture::make2d("visible triangles", GL_R32UI, view.size);
    }
    mTriangles.upload(0, seen.triangles().first(seen.pixels()));
    mTriangles.bind(kTrianglesUnit);
    world.bindTriangles();
    mProgram.use();
    mProgram.set(kToClip, view.toClip);
    mProgram.set(kPictureSize, glm::vec2(view.size));
    mNoAttributes.bind();
    state.depthTest = gl::DepthTest::Less; // the triangle lies at 0: where something is seen
    state.depthWrite = false;
    state.depthClamp = false;
    const std::vector<glm::ivec4> bounds = seen.boundsOfMeshes();
    for (std::size_t mesh = 0; mesh < world.meshCount(); ++mesh) {
        if (bounds[mesh].z == 0) {
            continue;
        }
        state.scissor = bounds[mesh];
        state.apply();
        world.setMesh(mProgram, mesh, mShows == Shows::Looks);
        mProgram.set(kMeshPlace, world.placeOf(mesh));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    GpuWorld::unbindLooks();
}

} // namespace celadon
