#include "app/material/exchange_json.h"
#include "renderer/scene/merge_gltf_material.h"
#include "subedit/errors.h"
#include "subedit/radius_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace celadon::app {
namespace {

using namespace subedit;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

json openPbr() {
    return {{"subsurface_color", {0.8, 0.5, 0.2}},
            {"subsurface_radius", 0.002},
            {"subsurface_radius_scale", {1.0, 0.5, 0.25}},
            {"specular_ior", 1.45},
            {"specular_roughness", 0.25}};
}

TEST(ExchangeJson, OpenPbrIsReadByItsConvention) {
    std::vector<std::string> notes;
    const SubsurfaceParameters p =
        parametersFromJson(openPbr(), "f.json", Convention::OpenPbr, 1000.0, notes);
    EXPECT_EQ(p.albedo, glm::dvec3(0.8, 0.5, 0.2));
    EXPECT_NEAR(p.meanFreePathMm.y, 1.0, 1e-12);
    EXPECT_EQ(p.eta, 1.45);
    EXPECT_TRUE(notes.empty());
    const MaterialMap map = materialFromParameters(p);
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).x, 0.8, 1e-4);
}

TEST(ExchangeJson, PrincipledIsReadByItsConvention) {
    std::vector<std::string> notes;
    const json given = {{"base_color", {0.8, 0.5, 0.2, 1.0}},
                        {"subsurface_radius", {1.0, 0.2, 0.1}},
                        {"subsurface_scale", 0.05},
                        {"subsurface_weight", 0.5}};
    const SubsurfaceParameters p =
        parametersFromJson(given, "f.json", Convention::Principled, 1000.0, notes);
    EXPECT_NEAR(p.meanFreePathMm.x, 50.0, 1e-9);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("subsurface_weight")));
}

TEST(ExchangeJson, ThereAndBackIsTheSame) {
    std::vector<std::string> notes;
    for (const Convention convention : {Convention::OpenPbr, Convention::Principled}) {
        SubsurfaceParameters p;
        p.albedo = {0.7, 0.4, 0.1};
        p.meanFreePathMm = {3.0, 1.0, 0.5};
        const NearestParameters nearest = nearestParameters(materialFromParameters(p, 128));
        EXPECT_FALSE(nearest.varies);
        EXPECT_LT(nearest.shapeError, 0.03);
        const SubsurfaceParameters back = parametersFromJson(
            parametersToJson(nearest, convention, 10.0), "x", convention, 10.0, notes);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(back.albedo[c], p.albedo[c], 1e-3);
            EXPECT_NEAR(back.meanFreePathMm[c] / p.meanFreePathMm[c], 1.0, 0.03) << c;
        }
    }
}

TEST(ExchangeJson, WhatAFileLeavesOutIsAsTheConventionHasIt) {
    std::vector<std::string> notes;
    const SubsurfaceParameters p = parametersFromJson(
        {{"subsurface_color", 0.5}, {"subsurface_radius", 0.001}, {"subsurface_radius_scal", 2.0}},
        "f", Convention::OpenPbr, 1000.0, notes);
    EXPECT_EQ(p.meanFreePathMm, glm::dvec3(1.0, 0.5, 0.25));
    EXPECT_EQ(p.eta, 1.5);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("no subsurface_radius_scale"),
                                   HasSubstr("'subsurface_radius_scal' is not known")));
    const SubsurfaceParameters three =
        parametersFromJson({{"subsurface_color", 0.5}, {"subsurface_radius", {3.0, 2.0, 1.0}}}, "f",
                           Convention::OpenPbr, 1.0, notes);
    EXPECT_EQ(three.meanFreePathMm, glm::dvec3(3.0, 2.0, 1.0));
}

TEST(ExchangeJson, ForwardScatteringIsReducedBySimilarity) {
    SubsurfaceParameters even;
    SubsurfaceParameters forward = even;
    forward.anisotropy = 0.8;
    EXPECT_GT(effectiveRadiusMm(profileAt(materialFromParameters(forward), 0, 0)).x,
              2.0 * effectiveRadiusMm(profileAt(materialFromParameters(even), 0, 0)).x);
}

TEST(ExchangeJson, ImpossibleFieldsAreNamed) {
    const auto expectRefused = [](const char* field, const json& value) {
        json given = openPbr();
        given[field] = value;
        std::vector<std::string> notes;
        try {
            static_cast<void>(
                parametersFromJson(given, "f.json", Convention::OpenPbr, 1000.0, notes));
            FAIL() << field << " " << value;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("'f.json'"), HasSubstr(field)));
        }
    };
    expectRefused("subsurface_color", {1.1, 0.5, 0.5});
    expectRefused("subsurface_color", {0.5, 0.5});
    expectRefused("subsurface_color", "red");
    expectRefused("subsurface_radius", -1.0);
    expectRefused("subsurface_radius", 0.0);
    expectRefused("specular_ior", 0.0);
    expectRefused("subsurface_scatter_anisotropy", 1.0);
    std::vector<std::string> notes;
    EXPECT_THROW(
        static_cast<void>(parametersFromJson(json::array(), "f", Convention::OpenPbr, 1.0, notes)),
        InputError);
    EXPECT_THROW(
        static_cast<void>(parametersFromJson(json::object(), "f", Convention::OpenPbr, 1.0, notes)),
        InputError);
}

TEST(ExchangeJson, GltfHasTheReferenceAndStandardExtensions) {
    SubsurfaceParameters p;
    p.meanFreePathMm = glm::dvec3(2.0);
    const json made = gltfMaterial(nearestParameters(materialFromParameters(p)), "wax",
                                   "materials/wax.subedit.exr");
    EXPECT_EQ(made["extras"]["subedit"], "materials/wax.subedit.exr");
    EXPECT_NEAR(made["extensions"]["KHR_materials_ior"]["ior"].get<double>(), 1.4, 1e-6);
    EXPECT_GT(made["extensions"]["KHR_materials_volume"]["attenuationDistance"].get<double>(), 0.0);
    EXPECT_NEAR(made["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.8, 1e-3);
    EXPECT_THAT(whatIsLost(nearestParameters(materialFromParameters(p)), Convention::Gltf),
                testing::Contains(HasSubstr("scatter")));
}

TEST(ExchangeJson, MergingLeavesTheRestOfADocument) {
    SubsurfaceParameters p;
    const json made = gltfMaterial(nearestParameters(materialFromParameters(p)), "wax", "w.exr");
    json document = {
        {"asset", {{"version", "2.0"}}},
        {"extensionsUsed", {"KHR_materials_ior"}},
        {"materials", {{{"name", "skin"}, {"normalTexture", {{"index", 3}}}}, {{"name", "cloth"}}}},
        {"meshes", json::array()}};
    loaders::mergeGltfMaterial(document, "m.gltf", "skin", made);
    EXPECT_EQ(document["materials"][0]["name"], "skin");
    EXPECT_EQ(document["materials"][0]["normalTexture"]["index"], 3);
    EXPECT_EQ(document["materials"][0]["extras"]["subedit"], "w.exr");
    EXPECT_FALSE(document["materials"][1].contains("extras"));
    EXPECT_EQ(document["extensionsUsed"].size(), 3u);
    loaders::mergeGltfMaterial(document, "m.gltf", "1", made);
    EXPECT_TRUE(document["materials"][1].contains("extras"));
    EXPECT_THROW(loaders::mergeGltfMaterial(document, "m.gltf", "7", made), InputError);
    EXPECT_THROW(loaders::mergeGltfMaterial(document, "m.gltf", "hair", made), InputError);
    json old = {{"asset", {{"version", "1.0"}}}};
    EXPECT_THROW(loaders::mergeGltfMaterial(old, "m.gltf", "", made), InputError);

    json bare = {{"asset", {{"version", "2.0"}}}, {"meshes", {{{"primitives", {{{"mode", 4}}}}}}}};
    loaders::mergeGltfMaterial(bare, "m.gltf", "", made);
    EXPECT_EQ(bare["meshes"][0]["primitives"][0]["material"], 0);
    EXPECT_EQ(bare["materials"].size(), 1u);
}

} // namespace
} // namespace celadon::app
