#include "renderer/scene/describe_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace celadon {

TEST(DescribeScene, SaysWhatThereIs) {
    Scene scene;
    scene.name = "thing";
    Mesh mesh;
    mesh.name = "part";
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uvs.assign(3, {0, 0});
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    SurfaceMaterial material;
    material.name = "jade";
    material.subedit = "m/jade.subedit.exr";
    material.baseColorTexture.image = 0;
    scene.materials.push_back(material);
    scene.images.push_back({"bark.png", 4, 2, {}});
    Light light;
    light.kind = Light::Kind::Point;
    light.position = {1, 2, 3};
    scene.lights.push_back(light);
    scene.warnings.push_back("something is odd");
    const std::vector<std::string> lines = describeScene(scene);
    EXPECT_THAT(
        lines, testing::IsSupersetOf(
                   {"name: thing", "meshes: 1", "triangles: 1", "vertices: 3",
                    "bounds: (0, 0, 0) to (2, 1, 0)", "millimeters per unit: not given by the file",
                    "mesh 0 'part': 1 triangle, 3 vertices, texture coordinates, material 0",
                    "picture 0 'bark.png': 4 x 2",
                    "light 0: point at (1, 2, 3), (1, 1, 1) "
                    "W/sr",
                    "warning: something is odd"}));
    EXPECT_THAT(lines, testing::Contains(testing::AllOf(
                           testing::HasSubstr("material 0 'jade'"),
                           testing::HasSubstr("SubEdit material 'm/jade.subedit.exr'"),
                           testing::HasSubstr("base color from picture 0 'bark.png'"))));
    for (const std::string& line : lines) {
        EXPECT_EQ(line.find('\n'), std::string::npos);
    }
}

TEST(DescribeScene, AnEmptySceneIsNoAccident) {
    EXPECT_THAT(describeScene(Scene()), testing::Contains("triangles: 0"));
}

} // namespace celadon
