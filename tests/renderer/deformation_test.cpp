#include "renderer/gpu_deformation.h"
#include "renderer/output/flicker.h"
#include "subedit/errors.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

// The GPU against the CPU, which computes in double precision by other code.

namespace celadon {
namespace {

using test::makeWorld;

/// Of the bounding sphere's radius: matrices and coordinates are floats there.
constexpr double kPosition = 1e-5;
constexpr double kNormalDegrees = 0.1;
/// The same picture from vertices that differ in their last bits: texels at edges change sides.
constexpr double kSameShape = 1e-4;

MaterialPointer wax() {
    return test::makeMaterial("wax", 1, 32, 20.0f, [](int, int) { return test::ProfileRecipe{}; });
}

DeformerStack deformers(const std::vector<std::string>& texts) {
    DeformerStack result;
    for (const std::string& text : texts) {
        result.push_back(parseDeformer(text));
    }
    return result;
}

class DeformationTest : public test::GlTest {
protected:
    /// Moves on both sides and compares every vertex, index and bound.
    static void compare(const World& rest, const GpuWorld& gpu, GpuDeformation& deformation,
                        const Pose& pose, const std::string& what) {
        SCOPED_TRACE(what);
        deformation.apply(pose);
        const GpuDeformation::Bounds bounds = deformation.bounds(pose);
        const World expected = posedWorld(rest, pose);
        const double radius = expected.sceneSphere.radius;
        double worstPosition = 0.0;
        double worstCosine = 1.0;
        for (std::size_t m = 0; m < rest.meshes.size(); ++m) {
            const DeformedMesh mesh = deformedMesh(rest, m, pose);
            const std::vector<float> drawn = gpu.geometry(m).readVertices();
            ASSERT_EQ(drawn.size(), mesh.positions.size() * GpuWorld::kVertexFloats);
            EXPECT_EQ(gpu.geometry(m).readIndices(),
                      expected.meshes[m].mesh.indices);
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                const float* const v = &drawn[i * GpuWorld::kVertexFloats];
                const glm::dvec3 p(v[0], v[1], v[2]);
                const glm::dvec3 n(v[3], v[4], v[5]);
                worstPosition = std::max(worstPosition, glm::length(p - mesh.positions[i]));
                if (glm::length(mesh.normals[i]) > 0.0) {
                    worstCosine = std::min(worstCosine, glm::dot(n, mesh.normals[i]));
                }
            }
        }
        EXPECT_LT(worstPosition, kPosition * radius);
        EXPECT_GT(worstCosine, std::cos(kNormalDegrees * std::numbers::pi / 180.0));
        for (const auto& [got, wanted] :
             {std::pair(bounds.scene, expected.sceneSphere),
              std::pair(bounds.scattering, expected.scatteringSphere)}) {
            EXPECT_LT(glm::length(got.center - wanted.center), kPosition * radius);
            EXPECT_NEAR(got.radius, wanted.radius, kPosition * radius);
        }
    }
};

TEST_F(DeformationTest, AnimatedModelsMatchDoublePrecisionAtTenTimes) {
    if (!test::modelFolder()) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    for (const char* const model : {"gltf/AnimatedMorphCube.glb", "gltf/MorphPrimitivesTest.glb",
                                    "gltf/CesiumMan.glb", "gltf/RiggedSimple.glb"}) {
        const World rest = makeWorld(model, wax());
        Motion motion(rest);
        const GpuScene scene(rest, {});
        GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
        for (std::size_t a = 0; a < std::max<std::size_t>(motion.animations().size(), 1); ++a) {
            double duration = 1.0;
            if (!motion.animations().empty()) {
                motion.selectAnimation(a);
                duration = motion.animations()[a].durationSeconds;
            }
            double movement = 0.0;
            for (int i = 0; i < 10; ++i) {
                const double seconds = duration * (i + 0.37) / 9.5; // the last one starts over
                motion.setDeformers({});
                const Pose pose = motion.at(seconds);
                compare(rest, scene.gpuWorld, deformation, pose,
                        fmt::format("{}, animation {} at {:.3f} s", model, a, seconds));
                const glm::dvec3 before(rest.meshes[0].mesh.positions[0]);
                for (const DeformedMesh& mesh : {deformedMesh(rest, 0, pose)}) {
                    movement = std::max(movement, glm::length(mesh.positions[0] - before));
                }
                motion.setDeformers(deformers({"twist:y:40", "inflate:0.5"}));
                compare(rest, scene.gpuWorld, deformation, motion.at(seconds),
                        fmt::format("{}, twisted, at {:.3f} s", model, seconds));
            }
            EXPECT_TRUE(motion.animations().empty() || movement > 0.0) << model;
        }
    }
}

TEST_F(DeformationTest, DeformersMatchDoublePrecision) {
    const World rest = makeWorld("builtin:vase", wax());
    Motion motion(rest);
    const GpuScene scene(rest, {});
    GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
    const std::vector<std::vector<std::string>> stacks{
        {"twist:y:90"},
        {"twist:x:-1000"},
        {"bend:y:120"},
        {"bend:z:-200"},
        {"bend:y:0.001"},
        {"taper:y:0.2"},
        {"taper:x:3"},
        {"wave:x:4:30"},
        {"inflate:2"},
        {"inflate:-1"},
        {"taper:y:0.5", "twist:y:180", "inflate:1", "bend:y:60", "wave:z:2:40"},
        {"twist:y:120:0.213,0.691", "bend:y:90:0.417,1"},
        {"taper:y:0.3:-0.5,0.373", "wave:y:3:25:0.31,0.77", "bend:z:-70:0.23,0.53"},
        {}};
    for (const std::vector<std::string>& texts : stacks) {
        motion.setDeformers(deformers(texts));
        std::string what;
        for (const std::string& text : texts) {
            what += text + " ";
        }
        compare(rest, scene.gpuWorld, deformation, motion.at(0.0), what);
    }
}

/// A lattice whose offsets no symmetry hides.
AnimatedDeformer crookedLattice(const glm::ivec3& size, double amplitudeUnits) {
    Deformer lattice;
    lattice.kind = Deformer::Kind::Lattice;
    lattice.lattice.size = size;
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        lattice.lattice.offsets.push_back(amplitudeUnits * glm::dvec3(std::sin(i * 1.7),
                                                                      std::cos(i * 2.3 + 1.0),
                                                                      std::sin(i * 0.9 + 2.0)));
    }
    return lattice;
}

TEST_F(DeformationTest, LatticesMatchDoublePrecision) {
    const World rest = makeWorld("builtin:vase", wax()); // 1 mm per unit
    Motion motion(rest);
    const GpuScene scene(rest, {});
    GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
    for (const glm::ivec3& size :
         {glm::ivec3(2), glm::ivec3(3, 4, 5), glm::ivec3(8), glm::ivec3(2, 8, 3)}) {
        motion.setDeformers({crookedLattice(size, 9.0)});
        compare(rest, scene.gpuWorld, deformation, motion.at(0.0),
                fmt::format("{} along x", size.x));
    }
    // Two of them, and what has left the box before it meets the second.
    motion.setDeformers({crookedLattice({3, 3, 3}, 6.0), parseDeformer("bend:y:80"),
                         crookedLattice({2, 5, 2}, 8.0), parseDeformer("inflate:1")});
    compare(rest, scene.gpuWorld, deformation, motion.at(0.0), "a stack");
}

/// Handles at both ends of the longest axis; the upper one is dragged and turned.
AnimatedDeformer twoHandles(const World& rest, double share) {
    AnimatedDeformer deformer;
    deformer.kind = Deformer::Kind::Handles;
    const Motion motion(rest);
    const RestBox box = motion.restBox();
    const glm::dvec3 extent = box.high - box.low;
    const int axis = extent.y >= std::max(extent.x, extent.z) ? 1 : extent.x >= extent.z ? 0 : 2;
    const double unit = rest.millimetersPerUnit;
    const double size = extent[axis];
    for (const double end : {box.low[axis], box.high[axis]}) {
        Handle handle;
        handle.at = 0.5 * (box.low + box.high) / unit;
        handle.at[axis] = end / unit;
        handle.radius = 0.12 * size / unit;
        deformer.handles.push_back(handle);
    }
    deformer.handles[1].move = KeyedNumbers::of(glm::dvec3(0.4, -0.1, 0.1) * share * size / unit);
    deformer.handles[1].turnDegrees = KeyedNumbers::of(glm::dvec3(0.0, 20.0, -40.0) * share);
    return deformer;
}

TEST_F(DeformationTest, HandlesMatchDoublePrecision) {
    // Small: every vertex is a node; large: a proxy carries them.
    for (const char* const model : {"builtin:vase", "builtin:sphere", "mesh/penguin_27k.obj",
                                    "mesh/koala_100k.obj", "gltf/Suzanne/Suzanne.gltf"}) {
        if (!std::string(model).starts_with("builtin") && !test::modelFolder()) {
            continue;
        }
        const World rest = makeWorld(model, wax());
        Motion motion(rest);
        const GpuScene scene(rest, {});
        GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
        for (const double share : {0.3, 1.0}) {
            motion.setDeformers({twoHandles(rest, share)});
            compare(rest, scene.gpuWorld, deformation, motion.at(0.0), model);
        }
        motion.setDeformers(
            {parseDeformer("twist:y:60"), twoHandles(rest, 0.5), parseDeformer("inflate:0.7")});
        compare(rest, scene.gpuWorld, deformation, motion.at(0.0),
                fmt::format("{}, twisted", model));
        motion.setDeformers({});
        compare(rest, scene.gpuWorld, deformation, motion.at(0.0),
                fmt::format("{} at rest", model));
    }
}

// What handles do to the rest shape goes along with the skin and the morph targets.
TEST_F(DeformationTest, HandlesBendAnimatedModelsToo) {
    if (!test::modelFolder()) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    for (const char* const model : {"gltf/CesiumMan.glb", "gltf/RiggedSimple.glb",
                                    "gltf/MorphPrimitivesTest.glb", "gltf/AnimatedMorphCube.glb"}) {
        const World rest = makeWorld(model, wax());
        Motion motion(rest);
        if (!motion.animations().empty()) {
            motion.selectAnimation(0);
        }
        const GpuScene scene(rest, {});
        GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
        motion.setDeformers({twoHandles(rest, 0.5), parseDeformer("inflate:0.5")});
        for (const double seconds : {0.0, 0.31, 0.77, 1.3}) {
            compare(rest, scene.gpuWorld, deformation, motion.at(seconds),
                    fmt::format("{} at {} s", model, seconds));
        }
    }
}

TEST_F(DeformationTest, TheDeformedFrameIsThatOfTheSameShape) {
    const World rest = makeWorld("builtin:vase", wax());
    Motion motion(rest);
    motion.setDeformers(deformers({"twist:y:70", "bend:y:40", "inflate:1"}));
    const Pose pose = motion.at(0.0);
    const World posed = posedWorld(rest, pose);
    const FrameSettings settings = test::smallFrame({96, 96}, 256, Scheme::Hierarchical);
    const Camera camera = test::defaultCamera(posed, settings.size);
    const std::vector<Light> lights{test::backLight(), test::frontLight()};
    const RenderedFrame expected = test::renderFrame(context(), posed, settings, camera, lights);

    const auto scene = std::make_shared<const GpuScene>(rest, settings);
    FrameRenderer renderer(context(), scene, settings);
    const RenderedFrame undeformed = renderer.render(camera, lights);
    GpuDeformation deformation(scene->shaders, rest, scene->gpuWorld);
    deformation.apply(pose);
    const RenderedFrame deformed = renderer.render(camera, lights);
    EXPECT_LT(test::compareExitance(deformed.image, expected.image).relativeRmse, kSameShape);
    EXPECT_GT(test::compareExitance(undeformed.image, expected.image).relativeRmse, 0.1);
}

// Highlights and shadows too: camera and lights stay, only the shape differs.
TEST_F(DeformationTest, HighlightsMoveWithTheShape) {
    const World rest = makeWorld("builtin:vase", wax());
    Motion motion(rest);
    motion.setDeformers(deformers({"bend:y:40"}));
    const Pose pose = motion.at(0.0);
    const World posed = posedWorld(rest, pose);
    FrameSettings settings = test::smallFrame({96, 96}, 64, Scheme::Hierarchical);
    settings.specular = true;
    settings.shadowSize = 256;
    const Camera camera = test::defaultCamera(posed, settings.size);
    const std::vector<Light> lights{test::frontLight()};
    const FloatImage expected =
        extractLayer(test::renderFrame(context(), posed, settings, camera, lights).image, "");

    const auto scene = std::make_shared<const GpuScene>(rest, settings);
    FrameRenderer renderer(context(), scene, settings);
    static_cast<void>(renderer.render(camera, lights));
    GpuDeformation deformation(scene->shaders, rest, scene->gpuWorld);
    deformation.apply(pose);
    const FloatImage moved = extractLayer(renderer.render(camera, lights).image, "");
    // Normals differ in their last bits, and highlights are sharp.
    EXPECT_LT(compareValues(moved, expected).relativeRmse, 0.01);
}

// What the pictures of a slow bend change from frame to frame beyond what the reference's change.
TEST_F(DeformationTest, ASlowDeformationDoesNotPop) {
    World rest = makeWorld("builtin:vase", wax());
    Motion motion(rest);
    const FrameSettings fast = test::smallFrame({96, 96}, 256, Scheme::Hierarchical);
    FrameSettings exact = fast;
    exact.solver = SolverKind::ImageReference;
    const auto scene = std::make_shared<const GpuScene>(rest, fast);
    FrameRenderer splatting(context(), scene, fast);
    FrameRenderer reference(context(), scene, exact);
    GpuDeformation deformation(scene->shaders, rest, scene->gpuWorld);
    const Camera camera = test::defaultCamera(rest, fast.size);
    const std::vector<Light> lights{test::backLight(), test::frontLight()};
    std::vector<FloatImage> shown;
    std::vector<FloatImage> truth;
    double largest = 0.0;
    double change = 0.0;
    for (int frame = 0; frame < 6; ++frame) {
        motion.setDeformers(deformers({fmt::format("bend:y:{}", 12.0 + 0.8 * frame)}));
        deformation.apply(motion.at(0.0));
        shown.push_back(extractLayer(splatting.render(camera, lights).image, "exitance"));
        truth.push_back(extractLayer(reference.render(camera, lights).image, "exitance"));
        if (frame > 0) {
            const auto n = static_cast<std::size_t>(frame);
            const Flicker flicker =
                measureFlicker({shown[n - 1], shown[n]}, {truth[n - 1], truth[n]});
            largest = std::max(largest, flicker.beyondTruth);
            change = std::max(change, flicker.trueChange);
        }
    }
    RecordProperty("largestPercent", std::to_string(100.0 * largest));
    EXPECT_LT(largest, 0.01);
    EXPECT_GT(change, 0.01); // it does move
}

TEST_F(DeformationTest, LightThroughAPlateFollowsItsThickness) {
    const MaterialPointer deep = test::makeMaterial("deep", 1, 48, 60.0f, [](int, int) {
        return test::ProfileRecipe{glm::dvec3(0.8), glm::dvec3(4.0)};
    });
    const World plate = makeWorld("builtin:slab", deep); // 20 mm thick
    Motion motion(plate);
    motion.setDeformers(deformers({"taper:x:0.3"})); // to 6 mm at +x
    const World rest = posedWorld(plate, motion.at(0.0));
    FrameSettings settings = test::smallFrame({64, 32}, 256, Scheme::Hierarchical);
    Camera camera;
    camera.eye = {0.0, 250.0, 0.0};
    camera.at = {0.0, 0.0, 0.0};
    camera.up = {0.0, 0.0, -1.0};
    camera.fovYDegrees = 12.0;
    const std::vector<Light> lights{test::directionalLight({0.0, 1.0, 0.0})};
    const RenderedFrame splatted = test::renderFrame(context(), rest, settings, camera, lights);
    settings.solver = SolverKind::ImageReference;
    const RenderedFrame reference = test::renderFrame(context(), rest, settings, camera, lights);
    double before = 0.0;
    double first = 0.0;
    for (int x = 4; x < 50; x += 5) { // beyond, light leaves at the thin end
        const glm::ivec2 pixel(x, 16);
        ASSERT_TRUE(test::seesScattering(reference.image, pixel)) << x;
        const double expected = test::exitanceAt(reference.image, pixel).x;
        EXPECT_NEAR(test::exitanceAt(splatted.image, pixel).x, expected, 0.02 * expected) << x;
        EXPECT_GT(expected, before) << "thinner, but not brighter, at column " << x;
        first = x == 4 ? expected : first;
        before = expected;
    }
    EXPECT_GT(before, 3.0 * first); // not a flat curve
}

TEST_F(DeformationTest, AnExplosionIsStoppedWithItsCause) {
    const World rest = makeWorld("builtin:sphere", wax());
    Motion motion(rest);
    const GpuScene scene(rest, {});
    GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
    motion.setDeformers(deformers({"twist:y:10", "taper:y:1e300"}));
    try {
        deformation.apply(motion.at(0.0));
        (void)deformation.bounds(motion.at(0.0));
        ADD_FAILURE() << "was deformed";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("deformer 2 of 2"));
    }
    motion.setDeformers({}); // the next pose is none the worse
    compare(rest, scene.gpuWorld, deformation, motion.at(0.0), "after the explosion");
}

} // namespace
} // namespace celadon
