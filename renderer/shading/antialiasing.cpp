#include "renderer/shading/antialiasing.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"
#include "renderer/shading/sample_ranges.h"
#include "renderer/surface_draw.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

constexpr int kMostPlaces = 16; ///< as coverage.glsl has it

/// Of the processor's samples: the grid turned such that every row and column has one.
constexpr std::array kProcessorPlaces{glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f),
                                      glm::vec2(-0.375f, 0.125f), glm::vec2(0.125f, 0.375f)};

/// Additive recurrence on the plastic number: well spread for any count of draws. In (-1/2, 1/2);
/// the first is 0.
glm::dvec2 jitter(int index) {
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 step(1.0 / kPlastic, 1.0 / (kPlastic * kPlastic));
    const glm::dvec2 position = 0.5 + step * static_cast<double>(index);
    return position - glm::floor(position) - 0.5;
}

int samplesOfADraw(int wanted) {
    GLint colors = 1;
    GLint depths = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colors);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depths);
    return std::min({wanted, colors, depths, kMostPlaces});
}

/// Of the framebuffer, which decides them.
std::vector<glm::vec2> samplePlaces(const gl::Framebuffer& framebuffer, int count) {
    gl::PassState::covering(framebuffer).apply();
    std::vector<glm::vec2> places(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < places.size(); ++i) {
        glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), &places[i].x);
        places[i] -= 0.5f;
    }
    return places;
}

} // namespace

Antialiasing::Antialiasing(const gl::ShaderLibrary& shaders, const SplattingBuffer& view,
                           int samples)
    : mColor(gl::Texture::make2d("color", GL_RGBA32F, view.size())),
      mFrameBlock("jittered frame", sizeof(blocks::FrameBlock), gl::BufferUse::Update),
      mEdges("edge pixels",
             static_cast<std::size_t>(view.size().x) * static_cast<std::size_t>(view.size().y)),
      mInterior("coverage inside", shaders, {"coverage_interior.comp"}),
      mEdge("coverage at edges", shaders, {"coverage_edge.comp"}) {
    if (shaders.isDefined("VISIBLE_TRIANGLES")) {
        makeSamplesOfProcessor(view);
    } else {
        makeSamplesOfDriver(shaders, view.size(), samples);
    }
    const auto ofADraw = static_cast<int>(mPlaces.size());
    mDraws = (samples + ofADraw - 1) / ofADraw;
}

void Antialiasing::makeSamplesOfProcessor(const SplattingBuffer& view) {
    mTiles.emplace(view.paddedSize(), 1);
    mPlaces.assign(kProcessorPlaces.begin(), kProcessorPlaces.end());
    const auto layers = static_cast<int>(mPlaces.size());
    mTriangles = gl::Texture::makeArray("coverage: triangles", GL_R32UI, view.size(), layers);
    mDepths = gl::Texture::makeArray("coverage: depths", GL_R32F, view.size(), layers);
    mRanges = gl::Texture::make2d("coverage: ranges of depths", GL_RG32F, view.size());
}

void Antialiasing::makeSamplesOfDriver(const gl::ShaderLibrary& shaders, glm::ivec2 size,
                                       int samples) {
    mSample = gl::Program("coverage", shaders, {"surface.vert", "splatting_buffer.frag"},
                          {{"CAMERA", "1"}, {"COVERAGE", "1"}});
    mSamples =
        gl::Texture::makeMultisampled("coverage: samples", GL_RG32F, size, samplesOfADraw(samples));
    mNormals =
        gl::Texture::makeMultisampled("coverage: normals", GL_RGBA16F, size, mSamples.samples());
    mDepthBuffer = gl::Texture::makeMultisampled("coverage: depth buffer", GL_DEPTH_COMPONENT32F,
                                                 size, mSamples.samples());
    mSampleFramebuffer =
        gl::Framebuffer("coverage", {{&mSamples}, {&mNormals}}, gl::Attachment{&mDepthBuffer});
    mPlaces = samplePlaces(mSampleFramebuffer, std::min(mSamples.samples(), kMostPlaces));
}

void Antialiasing::findSamples(const GpuWorld& world, const CameraView& jittered,
                               const SplattingBuffer& view) {
    mFrameBlock.write(std::array{makeFrameBlock(jittered, view.size(), view.paddedSize())});
    mFrameBlock.bindUniform(blocks::kFrame);
    if (!mTiles) {
        drawSamples(world);
        return;
    }
    RasterView seen = boundRasterView(world, SeenFrom::Camera, view.size()).value();
    seen.places = mPlaces;
    const TriangleRaster& raster = world.rasterize(seen);
    upload(world, raster.triangles(), raster.centerDepths(), view);
}

std::span<const glm::vec2> Antialiasing::placesToSee() const {
    return mTiles ? std::span<const glm::vec2>(mPlaces) : std::span<const glm::vec2>();
}

void Antialiasing::take(const GpuWorld& world, const TriangleRaster& seen,
                        const SplattingBuffer& view) {
    upload(world, seen.triangles().subspan(seen.pixels()),
           seen.centerDepths().subspan(seen.pixels()), view);
    mSamplesOf = view.drawn();
}

void Antialiasing::upload(const GpuWorld& world, std::span<const std::uint32_t> triangles,
                          std::span<const float> centerDepths, const SplattingBuffer& view) {
    std::vector<std::uint32_t> meshEnds;
    for (std::size_t mesh = 0; mesh < world.meshCount(); ++mesh) {
        meshEnds.push_back(static_cast<std::uint32_t>(world.placeOf(mesh).w));
    }
    findSampleRanges(triangles, centerDepths, mRanges.texelCount(0), meshEnds, mRangeTexels);
    mRanges.upload(0, std::span<const float>(&mRangeTexels.data()->x, 2 * mRangeTexels.size()));
    mTriangles.upload(0, triangles);
    mDepths.upload(0, centerDepths);
    mTiles->find(triangles, view.size(), view.coveredTiles());
}

void Antialiasing::drawSamples(const GpuWorld& world) {
    gl::PassState state = gl::PassState::covering(mSampleFramebuffer);
    state.depthTest = gl::DepthTest::Greater;
    state.depthWrite = true;
    state.apply();
    mSampleFramebuffer.clearColor(0, glm::vec4(0.0f));
    mSampleFramebuffer.clearColor(1, glm::vec4(0.0f));
    mSampleFramebuffer.clearDepth(0.0f);
    world.draw(mSample, false);
}

void Antialiasing::resolveDraw(const GpuWorld& world, const SplattingBuffer& view,
                               const gl::Texture& radiance, glm::dvec2 offset, bool isFirst) {
    mEdges.clear();
    view.positions().bind(0);
    view.normals().bind(1);
    radiance.bind(2);
    (mTiles ? mTriangles : mSamples).bind(3);
    (mTiles ? mDepths : mNormals).bind(4);
    if (mTiles) {
        mRanges.bind(5);
        world.bindTriangles();
        world.places().bindStorage(1);
    }
    mColor.bindImage(0, 0, GL_READ_WRITE);
    const auto samples = static_cast<int>(mPlaces.size());
    for (const gl::Program* program : {&mInterior, &mEdge}) {
        program->set(0, glm::vec3(offset, 1.0 / (samples * mDraws)));
        program->set(1, samples);
        program->set(2, std::span<const glm::vec2>(mPlaces));
        program->set(2 + kMostPlaces, isFirst);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    mInterior.use();
    if (mTiles && isFirst) {
        mTouched.dispatch(mInterior, *mTiles, 0);
    } else if (mTiles) { // a rim may be seen by this draw only
        mTiles->dispatch(mInterior, 0);
        mTouched.add(*mTiles, 0);
    } else {
        mInterior.dispatchOver(view.size());
    }
    mEdges.dispatch(mEdge);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void Antialiasing::resolve(const GpuWorld& world, const Camera& camera, const SplattingBuffer& view,
                           const gl::Texture& radiance) {
    const gl::DebugGroup group("antialiasing");
    for (int i = 0; i < mDraws; ++i) {
        // The picture moves against the draw's offset from the pixel's center.
        const glm::dvec2 offset = jitter(i);
        if (i > 0 || mSamplesOf != view.drawn()) {
            findSamples(world, makeCameraView(camera, view.size().x, view.size().y, -offset), view);
            mSamplesOf = i == 0 ? view.drawn() : 0;
        }
        resolveDraw(world, view, radiance, offset, i == 0);
    }
}

} // namespace celadon
