#include "renderer/scene/builtin.h"
#include "renderer/scene/world.h"
#include "subedit/errors.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace celadon {
namespace {

MaterialPointer makeMaterial() {
    return std::make_shared<subedit::MaterialMap>();
}

/// Two tetrahedra with uvs: one of size 1 at the origin with look 0, one of size 3 with look 1.
Scene twoParts() {
    Scene scene;
    scene.materials.resize(2);
    for (int part = 0; part < 2; ++part) {
        Mesh mesh;
        const float size = part == 0 ? 1.0f : 3.0f;
        mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.uvs.assign(4, {0, 0});
        mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        mesh.material = part;
        scene.meshes.push_back(mesh);
    }
    return scene;
}

TEST(BuildWorld, AMaterialForAllMakesEveryMeshScatter) {
    const MaterialPointer wax = makeMaterial();
    const World world = buildWorld(twoParts(), wax, {nullptr, makeMaterial()}, makeMaterial(), {});
    ASSERT_EQ(world.materials.size(), 1u);
    EXPECT_EQ(world.materials[0], wax);
    EXPECT_EQ(world.meshes[0].scattering, 0);
    EXPECT_EQ(world.meshes[1].scattering, 0);
}

TEST(BuildWorld, NamedMaterialsLeaveTheOthersOpaque) {
    const MaterialPointer jade = makeMaterial();
    const World world = buildWorld(twoParts(), nullptr, {jade, nullptr}, makeMaterial(), {});
    EXPECT_EQ(world.meshes[0].scattering, 0);
    EXPECT_EQ(world.meshes[1].scattering, -1);
    ASSERT_EQ(world.materials.size(), 1u);
    EXPECT_EQ(world.materials[0], jade);
    // The size is that of what scatters: the small part's; the other part reaches further.
    EXPECT_NEAR(2.0 * world.scatteringSphere.radius, 100.0, 1e-4);
    EXPECT_NEAR(2.0 * world.sceneSphere.radius, 300.0, 1e-3);
}

TEST(BuildWorld, NothingNamedMeansTheFallbackEverywhere) {
    const MaterialPointer fallback = makeMaterial();
    const World world = buildWorld(twoParts(), nullptr, {}, fallback, {});
    ASSERT_EQ(world.materials.size(), 1u);
    EXPECT_EQ(world.materials[0], fallback);
    EXPECT_EQ(world.meshes[1].scattering, 0);
}

TEST(BuildWorld, EachMaterialIsListedOnce) {
    const MaterialPointer a = makeMaterial();
    const MaterialPointer b = makeMaterial();
    World world = buildWorld(twoParts(), nullptr, {a, b}, nullptr, {});
    EXPECT_EQ(world.materials.size(), 2u);
    EXPECT_EQ(world.meshes[1].scattering, 1);
    world = buildWorld(twoParts(), nullptr, {a, a}, nullptr, {});
    EXPECT_EQ(world.materials.size(), 1u);
}

TEST(BuildWorld, ScaleIsGivenOrFromTheFileOrAHundredMillimeters) {
    const MaterialPointer wax = makeMaterial();
    Scene scene = twoParts();
    const double radius = boundingSphere(scene).radius;
    EXPECT_NEAR(buildWorld(scene, wax, {}, wax, {}).millimetersPerUnit, 50.0 / radius, 1e-9);
    scene.millimetersPerUnit = 1000.0;
    EXPECT_EQ(buildWorld(scene, wax, {}, wax, {}).millimetersPerUnit, 1000.0);
    EXPECT_EQ(buildWorld(scene, wax, {}, wax, {2.0, {}}).millimetersPerUnit, 2.0);
    EXPECT_NEAR(buildWorld(scene, wax, {}, wax, {{}, 30.0}).scatteringSphere.radius, 15.0, 1e-4);
}

TEST(BuildWorld, PositionsCamerasAndLightsBecomeMillimeters) {
    Scene scene = twoParts();
    Camera camera;
    camera.eye = {0.0, 0.0, 5.0};
    camera.orthographicHeight = 2.0;
    scene.cameras.push_back(camera);
    Light light;
    light.kind = Light::Kind::Point;
    light.position = {1.0, 2.0, 3.0};
    light.color = {4.0, 5.0, 6.0};
    scene.lights.push_back(light);
    const World world = buildWorld(scene, makeMaterial(), {}, nullptr, {10.0, {}});
    EXPECT_EQ(world.meshes[1].mesh.positions[1], glm::vec3(30.0f, 0.0f, 0.0f));
    EXPECT_EQ(world.cameras[0].eye, glm::dvec3(0.0, 0.0, 50.0));
    EXPECT_EQ(world.cameras[0].orthographicHeight, 20.0);
    EXPECT_EQ(world.lights[0].position, glm::dvec3(10.0, 20.0, 30.0));
    EXPECT_EQ(world.lights[0].color, light.color);
}

TEST(ResizedWorld, IsTheOneThatIsBuiltThatLarge) {
    Scene scene = twoParts();
    Camera camera;
    camera.eye = {0, 2, 5};
    camera.orthographicHeight = 3.0;
    scene.cameras = {camera};
    Light light;
    light.position = {4, 5, 6};
    scene.lights = {light};
    const MaterialPointer jade = makeMaterial();
    const auto built = [&](double diameterMm) {
        return buildWorld(scene, nullptr, {jade, nullptr}, makeMaterial(), {{}, diameterMm});
    };
    const World world = resized(built(100.0), 2.5);
    const World expected = built(250.0);
    EXPECT_NEAR(world.millimetersPerUnit, expected.millimetersPerUnit, 1e-9);
    EXPECT_NEAR(world.scatteringSphere.radius, 125.0, 1e-3);
    EXPECT_NEAR(world.sceneSphere.radius, expected.sceneSphere.radius, 1e-3);
    EXPECT_LT(glm::distance(world.sceneSphere.center, expected.sceneSphere.center), 1e-3);
    for (std::size_t m = 0; m < world.meshes.size(); ++m) {
        const Mesh& mesh = world.meshes[m].mesh;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_LT(glm::distance(mesh.positions[i], expected.meshes[m].mesh.positions[i]),
                      1e-3f);
        }
        EXPECT_EQ(mesh.uvs, expected.meshes[m].mesh.uvs);
    }
    EXPECT_LT(glm::distance(world.cameras[0].eye, expected.cameras[0].eye), 1e-9);
    EXPECT_NEAR(*world.cameras[0].orthographicHeight, *expected.cameras[0].orthographicHeight,
                1e-9);
    EXPECT_LT(glm::distance(world.lights[0].position, expected.lights[0].position), 1e-9);
    EXPECT_EQ(world.lights[0].color, light.color);
    EXPECT_EQ(world.materials, expected.materials);
    EXPECT_NE(world.handleGround, nullptr);
    EXPECT_THROW(static_cast<void>(resized(world, 1e300)), InputError);
}

TEST(BuildWorld, RefusesWhatHasNoSize) {
    const MaterialPointer wax = makeMaterial();
    EXPECT_THROW((void)buildWorld(Scene{}, wax, {}, wax, {}), InputError);
    EXPECT_THROW((void)buildWorld(twoParts(), nullptr, {}, nullptr, {}), InputError);
    Scene point = twoParts();
    for (Mesh& mesh : point.meshes) {
        mesh.positions.assign(4, {7, 7, 7});
    }
    EXPECT_THROW((void)buildWorld(point, wax, {}, wax, {}), InputError);
    Scene hostile = twoParts();
    hostile.meshes[0].positions[1].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW((void)buildWorld(hostile, wax, {}, wax, {}), InputError);
    hostile.meshes[0].positions[1].x = std::numeric_limits<float>::infinity();
    EXPECT_THROW((void)buildWorld(hostile, wax, {}, wax, {}), InputError);
    EXPECT_THROW((void)buildWorld(twoParts(), wax, {}, wax, {1e30, {}}), InputError);
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW((void)buildWorld(twoParts(), wax, {}, wax, {bad, {}}), UsageError);
        EXPECT_THROW((void)buildWorld(twoParts(), wax, {}, wax, {{}, bad}), UsageError);
    }
    EXPECT_THROW((void)buildWorld(twoParts(), wax, {}, wax, {1.0, 1.0}), UsageError);
}

} // namespace
} // namespace celadon
