// Light views as the GPU makes them: what they must see, which of them are in use, and that nothing
// is drawn or computed for the others.
#include "renderer/gl/pass_state.h"
#include "renderer/gpu_deformation.h"
#include "renderer/splatting/light_views.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace celadon {
namespace {

constexpr int kSize = 64;
constexpr float kRounding = 1e-4f; ///< float matrices over a sphere seen from a few radii

class LightViewsTest : public test::GlTest {
protected:
    LightViewsTest() : mScene(mWorld, {}), mViews(mScene.shaders, kTarget, kSize) {}

    std::vector<blocks::LightBlock> viewsOf(const Light& light) {
        mViews.update(std::array{light}, mScene.gpuWorld);
        std::vector<blocks::LightBlock> used;
        for (int i = 0; i < mViews.count(); ++i) {
            const blocks::LightBlock block = mViews.read(i);
            EXPECT_EQ(mViews.isUsed(i), block.direction.w > 0.0f);
            if (block.direction.w > 0.0f) {
                EXPECT_EQ(block.direction.w, float(kSize));
                used.push_back(block);
            }
        }
        return used;
    }

    [[nodiscard]] glm::dvec3 onSphere(int i) const {
        const double z = 1.0 - 2.0 * (i + 0.5) / kPoints;
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - z * z);
        return center() + radius() * glm::dvec3(r * std::cos(angle), r * std::sin(angle), z);
    }
    [[nodiscard]] glm::dvec3 center() const { return mWorld.scatteringSphere.center; }
    [[nodiscard]] double radius() const { return mWorld.scatteringSphere.radius; }

    static constexpr LightViews::Target kTarget = LightViews::Target::Scattering;
    static constexpr int kPoints = 500;
    World mWorld = test::makeWorld("builtin:vase", test::longRangeMaterial());
    GpuScene mScene;
    LightViews mViews;
};

glm::vec3 clipOf(const blocks::LightBlock& view, const glm::dvec3& point, float& w) {
    const glm::vec4 clip = view.viewProjection * glm::vec4(glm::vec3(point), 1.0f);
    w = clip.w;
    return glm::vec3(clip) / clip.w;
}

TEST_F(LightViewsTest, OneFrustumFitsTheSphere) {
    const glm::dvec3 side = glm::normalize(glm::dvec3(0.5, 0.6, 0.7));
    Light spot = test::pointLight(center() + 3.0 * radius() * side);
    spot.kind = Light::Kind::Spot;
    spot.direction = -side;
    spot.outerConeRadians = 0.9;
    for (const Light& light :
         {test::frontLight(), test::pointLight(center() + 1.3 * radius() * side),
          test::pointLight(center() + 40.0 * radius() * side), spot}) {
        const auto views = viewsOf(light);
        ASSERT_EQ(views.size(), 1u);
        float widest = 0.0f;
        for (int i = 0; i < kPoints; ++i) {
            float w = 0.0f;
            const glm::vec3 clip = clipOf(views[0], onSphere(i), w);
            EXPECT_GT(w, 0.0f);
            EXPECT_GE(clip.z, 0.0f);
            EXPECT_LE(clip.z, 1.0f);
            widest = std::max({widest, std::abs(clip.x), std::abs(clip.y)});
        }
        EXPECT_LT(widest, 1.0f);
        EXPECT_GT(widest, 0.97f); // and wastes nothing
    }
}

TEST_F(LightViewsTest, ANarrowSpotSeesItsCone) {
    Light spot = test::pointLight(center() + glm::dvec3(0.0, 0.0, 3.0 * radius()));
    spot.kind = Light::Kind::Spot;
    spot.direction = {0.0, 0.0, -1.0};
    spot.outerConeRadians = 0.1;
    const auto views = viewsOf(spot);
    ASSERT_EQ(views.size(), 1u);
    float w = 0.0f;
    const glm::dvec3 rim = spot.position + glm::dvec3(std::tan(0.1), 0.0, -1.0) * 10.0;
    EXPECT_NEAR(glm::length(glm::vec2(clipOf(views[0], rim, w))), 1.0f, 0.001f);
}

TEST_F(LightViewsTest, SixFacesSeeEachDirectionOnce) {
    const Light light = test::pointLight(center() + glm::dvec3(0.4 * radius(), 0.0, 0.0));
    const auto views = viewsOf(light);
    ASSERT_EQ(views.size(), 6u);
    for (int i = 0; i < kPoints; ++i) {
        int seen = 0;
        for (const blocks::LightBlock& view : views) {
            float w = 0.0f;
            const glm::vec3 clip = clipOf(view, onSphere(i), w);
            seen += w > 0.0f && std::max(std::abs(clip.x), std::abs(clip.y)) < 1.0f - kRounding;
        }
        EXPECT_LE(seen, 1) << i;
        EXPECT_GE(seen, 0) << i;
    }
}

// The bounds are nowhere but on the GPU: the views of a moved shape are those of the shape itself.
TEST_F(LightViewsTest, FollowAShapeThatMoves) {
    Motion motion(mWorld);
    motion.setDeformers({parseDeformer("bend:y:80"), parseDeformer("inflate:6")});
    const Pose pose = motion.at(0.0);
    GpuDeformation deformation(mScene.shaders, mWorld, mScene.gpuWorld);
    deformation.apply(pose);
    const World posed = posedWorld(mWorld, pose);
    const GpuScene posedScene(posed, {});
    const glm::dvec3 side(0.0, 0.0, 1.0);
    // The last is outside the shape at rest, and inside the one that moved.
    const glm::dvec3 farther =
        posed.scatteringSphere.center + 1.2 * posed.scatteringSphere.radius * side;
    for (const Light& light :
         {test::frontLight(), test::pointLight(center() + 4.0 * radius() * side),
          test::pointLight(farther)}) {
        LightViews expected(posedScene.shaders, kTarget, kSize);
        expected.update(std::array{light}, posedScene.gpuWorld);
        mViews.update(std::array{light}, mScene.gpuWorld);
        ASSERT_EQ(mViews.count(), expected.count());
        for (int i = 0; i < mViews.count(); ++i) {
            const blocks::LightBlock a = mViews.read(i);
            const blocks::LightBlock b = expected.read(i);
            EXPECT_EQ(a.direction.w, b.direction.w) << i;
            for (int p = 0; p < kPoints; p += 50) {
                float w = 0.0f;
                const glm::vec3 difference = clipOf(a, onSphere(p), w) - clipOf(b, onSphere(p), w);
                EXPECT_LT(glm::length(difference), 10.0f * kRounding) << i;
            }
        }
    }
    EXPECT_TRUE(mViews.isUsed(5)) << "the last light is too close for a single frustum";
}

TEST_F(LightViewsTest, NothingHappensForAViewNotInUse) {
    const Light light = test::pointLight(center() + glm::dvec3(0.0, 0.0, 3.0 * radius()));
    mViews.update(std::array{light}, mScene.gpuWorld);
    ASSERT_EQ(mViews.count(), 6);
    gl::Texture target = gl::Texture::make2d("target", GL_RGBA32F, glm::ivec2(4));
    gl::Framebuffer framebuffer("target", {{&target}});
    for (int i = 0; i < mViews.count(); ++i) {
        target.clear(0, glm::vec4(0.0f));
        {
            const LightViews::Scope whereUsed = mViews.whereUsed(i);
            gl::PassState::covering(framebuffer).apply();
            framebuffer.clearColor(0, glm::vec4(1.0f));
        }
        EXPECT_EQ(target.readLevel(0)[0], i == 0 ? 1.0f : 0.0f) << i;
    }
}

// No frame waits for what the GPU has: the calls by which results come back are counted.
class NoReadBack : public LightViewsTest {
protected:
    static inline int sReads = 0;

    template<class... Arguments>
    class Counted {
    public:
        explicit Counted(void (*&function)(Arguments...)) : mFunction(function), mBefore(function) {
            mFunction = [](Arguments...) { ++sReads; };
        }
        ~Counted() { mFunction = mBefore; }
        Counted(const Counted&) = delete;
        Counted& operator=(const Counted&) = delete;

    private:
        void (*&mFunction)(Arguments...);
        void (*mBefore)(Arguments...);
    };
};

TEST_F(NoReadBack, InAFrameOfADeformedShape) {
    Motion motion(mWorld);
    motion.setDeformers({parseDeformer("twist:y:40")});
    GpuDeformation deformation(mScene.shaders, mWorld, mScene.gpuWorld);
    for (const SplatBackendKind backend : {SplatBackendKind::Raster, SplatBackendKind::Tiled}) {
        FrameSettings settings = test::smallFrame({48, 36}, 32, Scheme::Hierarchical);
        settings.splatting.backend = backend;
        settings.rasterizer = Rasterizer::Driver; // as where there is a GPU
        settings.specular = true;
        const auto scene = std::make_shared<const GpuScene>(mWorld, settings);
        FrameRenderer renderer(context(), scene, settings);
        const Camera camera = test::defaultCamera(mWorld, settings.size);
        const std::array lights{test::frontLight(),
                                test::pointLight(center() + glm::dvec3(0.0, 0.0, 2.0 * radius()))};
        const Counted buffers(glad_glGetNamedBufferSubData);
        const Counted textures(glad_glGetTextureImage);
        const Counted regions(glad_glGetTextureSubImage);
        const Counted pixels(glad_glReadPixels);
        const Counted queries(glad_glGetQueryObjectuiv);
        sReads = 0;
        deformation.apply(motion.at(0.0));
        EXPECT_NE(renderer.draw(camera, lights, nullptr), nullptr);
        EXPECT_EQ(sReads, 0);
        static_cast<void>(scene->gpuWorld.readBounds());
        EXPECT_EQ(sReads, 1); // the count would have seen it
    }
}

} // namespace
} // namespace celadon
