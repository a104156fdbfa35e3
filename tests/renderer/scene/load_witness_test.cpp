#include "renderer/scene/load_scene.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

/// OpenMesh reads the same files, as an independent witness: the same triangles, corner by corner,
/// at the same places and in the same order. Only manifold models: it drops faces of others.
namespace celadon {

namespace {

class WitnessTest : public testing::TestWithParam<const char*> {};

TEST_P(WitnessTest, SeesTheSameTriangles) {
    const char* const folder = std::getenv("CELADON_MODELS");
    if (folder == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const std::filesystem::path file = std::filesystem::path(folder) / GetParam();
    OpenMesh::TriMesh_ArrayKernelT<> witness;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(witness, file.string()));
    const Mesh mesh = loadScene(file).meshes.at(0);
    ASSERT_EQ(witness.n_faces(), mesh.triangleCount());
    std::size_t corner = 0;
    for (const auto face : witness.faces()) {
        for (const auto vertex : face.vertices()) {
            const auto& p = witness.point(vertex);
            ASSERT_EQ(glm::vec3(p[0], p[1], p[2]), mesh.positions[mesh.indices[corner]])
                << "corner " << corner;
            ++corner;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, WitnessTest,
                         testing::Values("mesh/bunny_watertight_60k.obj", "mesh/hand_16k.obj",
                                         "mesh/spot_uv.obj", "mesh/stanford_bunny_69k_ascii.ply"),
                         [](const auto& instance) {
                             return std::filesystem::path(instance.param).stem().string();
                         });

} // namespace

} // namespace celadon
