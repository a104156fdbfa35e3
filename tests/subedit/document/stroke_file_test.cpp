#include "subedit/document/stroke_file.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "tests/subedit/support/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace celadon::subedit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

StoredProfile profile() {
    return {8, 12.3f, test::exponentialMaterial(8, 12.3f, {1.1f, 0.9f, 0.7f}).logProfile};
}

/// Every command, operator and selection step, with floats that no short decimal stands for.
StrokeFile everything() {
    const StrokePoint a{{0.1f, -1.0f / 3.0f, 7.7f}, {0.6f, 0.0f, 0.8f}, {}, 0.3f};
    const StrokePoint b{{}, {}, glm::vec2(0.1f, 2.0f / 3.0f), 1.0f};
    StrokePoint lifted = a;
    lifted.isLifted = true;
    const StrokePoint place{{0.1f, -1.0f / 3.0f, 7.7f}, {0.6f, 0.0f, 0.8f}, {}, 1.0f};
    Mirror mirror;
    mirror.axes = {true, false, true};
    mirror.centerMm = {0.1f, 0.2f, 0.3f};
    const Brush brush{1.0f / 7.0f, 0.1f, 0.2f, 0.9f, 0.7f};
    const Propagation propagation{
        {{brush, mirror, {a, b}, 0.7f}, {brush, {}, {b}, 0.0f}}, 0.123f, 17.1f};
    StrokeFile file;
    file.surface.model = "models/bust \"x\".obj";
    file.surface.texels = glm::ivec2(512, 256);
    for (const EditOperator& op : std::vector<EditOperator>{
             ScaleAlbedo{{0.1f, 0.2f, 1.3f}}, SetAlbedo{{0.1f, 0.7f, 1.0f}},
             Tint{{0.1f, 2.0f, 0.3f}, 0.4f}, ScaleRange{{0.1f, 1.7f, 3.3f}},
             SetRange{{0.1f, 1.7f, 3.3f}}, SetShape{profile()}, Mix{profile(), 0.3f},
             Gradient{profile(), profile(), {0.1f, 0.2f, 0.3f}, {1.1f, 0.2f, 0.3f}},
             Heterogeneity{-0.3f, 2.2f}, Clone{{place, b, 33.3f}},
             TransferPattern{{b, place, -12.1f}, 3.3f, 1.1f}}) {
        file.commands.push_back(ApplyCommand{op});
        file.commands.push_back(StrokeCommand{op, brush, mirror, {a, b, lifted}});
        file.commands.push_back(PropagateCommand{op, propagation});
        file.commands.push_back(StampCommand{op,
                                             {place,
                                              12.3f,
                                              -33.3f,
                                              3,
                                              2,
                                              {0, 1, 127, 128, 254, 255},
                                              {{true, false, true}, {1.0f, 2.0f, 0.1f}}}});
    }
    for (const SelectionStep& step : std::vector<SelectionStep>{
             SelectAll{}, SelectNone{}, InvertSelection{}, GrowSelection{0.1f},
             ShrinkSelection{0.7f}, FeatherSelection{1.1f}}) {
        file.commands.push_back(SelectCommand{step, SelectMode::Replace});
    }
    file.commands.push_back(SelectCommand{SelectStroke{brush, mirror, {a}}, SelectMode::Add});
    file.commands.push_back(
        SelectCommand{SelectSimilar{place, 0.1f, 0.2f, 3.3f}, SelectMode::Subtract});
    file.commands.push_back(SelectCommand{propagation, SelectMode::Intersect});
    return file;
}

std::string withCommand(const std::string& command) {
    return R"({"format": "celadon-strokes", "version": 1, "commands": [)" + command + "]}";
}

std::string withOperator(const std::string& op) {
    return withCommand(R"({"command": "apply", "operator": )" + op + "}");
}

std::string refusal(const std::string& text) {
    try {
        static_cast<void>(parseStrokeFile("'s.json'", text));
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
}

TEST(StrokeFile, WhatIsWrittenReadsBackEqual) {
    const StrokeFile file = everything();
    const std::string text = strokeFileText(file);
    const StrokeFile back = parseStrokeFile("'s.json'", text);
    ASSERT_EQ(back.commands.size(), file.commands.size());
    for (std::size_t i = 0; i < file.commands.size(); ++i) {
        EXPECT_EQ(back.commands[i], file.commands[i]) << commandTitle(file.commands[i]);
        EXPECT_EQ(parseCommand("line", commandText(file.commands[i])), file.commands[i]);
    }
    EXPECT_EQ(back.surface, file.surface);
    EXPECT_EQ(strokeFileText(back), text);
}

TEST(StrokeFile, ProfilesCanBeGivenByAppearanceOrMaterial) {
    const StrokeFile byAppearance =
        parseStrokeFile("'s.json'", withOperator(R"({"name": "mix", "profile":
            {"albedo": [0.9, 0.5, 0.2], "effectiveRadiusMm": [8, 4, 2], "segments": 40}})"));
    const auto& mix = std::get<Mix>(std::get<ApplyCommand>(byAppearance.commands[0]).op);
    EXPECT_EQ(mix.profile.segments, 40);
    EXPECT_NEAR(diffuseAlbedo(mix.profile.view()).x, 0.9, 1e-3);
    EXPECT_NEAR(effectiveRadiusMm(mix.profile.view()).y, 4.0, 0.1);

    const std::string byMaterial =
        withOperator(R"({"name": "mix", "profile": {"material": "jade", "uv": [0.25, 0.75]}})");
    const StrokeFile file =
        parseStrokeFile("'s.json'", byMaterial, [](const std::string& name, glm::vec2 uv) {
            EXPECT_EQ(name, "jade");
            EXPECT_EQ(uv, glm::vec2(0.25f, 0.75f));
            return profile();
        });
    EXPECT_EQ(std::get<Mix>(std::get<ApplyCommand>(file.commands[0]).op).profile, profile());
    EXPECT_THAT(refusal(byMaterial), HasSubstr("/commands/0/operator/profile/material"));
}

TEST(StrokeFile, RefusalsNameThePlaceAndTheReason) {
    const auto at = [](const std::string& pointer) { return HasSubstr("'s.json', " + pointer); };
    EXPECT_THAT(refusal("{\n\"format\": x"), AllOf(HasSubstr("not JSON"), HasSubstr("line 2")));
    EXPECT_THAT(refusal("[]"), HasSubstr("not an object"));
    EXPECT_THAT(refusal("{}"), at("/format: is missing"));
    EXPECT_THAT(refusal(R"({"format": "x"})"), at("/format"));
    EXPECT_THAT(refusal(R"({"format": "celadon-strokes", "version": 2, "commands": []})"),
                AllOf(at("/version"), HasSubstr("2")));
    EXPECT_THAT(refusal(R"({"format": "celadon-strokes", "version": 1, "commands": {}})"),
                at("/commands: is {}, not a list"));
    EXPECT_THAT(refusal(withCommand(R"({"command": "paint"})")),
                AllOf(at("/commands/0/command: \"paint\" is no command"), HasSubstr("stroke")));
    EXPECT_THAT(refusal(withOperator(R"({"name": "brighten"})")),
                AllOf(at("/commands/0/operator/name: \"brighten\" is no operator"),
                      HasSubstr("scale-albedo")));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo"})")),
                at("/commands/0/operator/factor: is missing"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": [1, -0.5, 1]})")),
                AllOf(at("/commands/0/operator/factor/1"), HasSubstr("-0.5")));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": [1, null, 1]})")),
                at("/commands/0/operator/factor/1: is null, not a number"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": [1, NaN, 1]})")),
                HasSubstr("not JSON"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": [1, 1e999, 1]})")),
                HasSubstr("1e999"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": [1, 1e300, 1]})")),
                at("/commands/0/operator/factor/1"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-albedo", "factor": 2})")),
                HasSubstr("not three numbers"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "set-albedo", "albedo": [0.5, 0.5, 1.5]})")),
                AllOf(at("/commands/0/operator/albedo/2"), HasSubstr("[0, 1]")));
    EXPECT_THAT(
        refusal(withOperator(R"({"name": "set-albedo", "albedo": [0.5, 0.5, 0.5], "a/b": 1})")),
        AllOf(at("/commands/0/operator/a~1b: is an unknown field"), HasSubstr("albedo")));
    EXPECT_THAT(refusal(withOperator(R"({"name": "tint", "color": [0, 0, 0]})")),
                at("/commands/0/operator/color"));
    EXPECT_THAT(refusal(withOperator(R"({"name": "scale-range", "factor": [1, 0, 1]})")),
                at("/commands/0/operator/factor/1"));
    EXPECT_THAT(refusal(withOperator(
                    R"({"name": "mix", "profile": {"maxRadiusMm": 10, "knots": [[1, 2, 3]]}})")),
                at("/commands/0/operator/profile/knots: are 1"));
    EXPECT_THAT(
        refusal(withOperator(
            R"({"name": "mix", "profile": {"maxRadiusMm": 10, "knots": [[1, 2, 3], [1, 2]]}})")),
        at("/commands/0/operator/profile/knots/1"));
    EXPECT_THAT(
        refusal(withOperator(
            R"({"name": "mix", "profile": {"maxRadiusMm": 10, "knots": [[1, 2, 3], [1, 2, 99]]}})")),
        at("/commands/0/operator/profile/knots/1/2"));
    const auto stroke = [](const std::string& brush, const std::string& path) {
        return withCommand(
            R"({"command": "stroke", "operator": {"name": "scale-albedo", "factor": [1, 1, 1]},
                "brush": )" +
            brush + R"(, "path": )" + path + "}");
    };
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 0})", "[]")), at("/commands/0/brush/radiusMm"));
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 1, "flow": 0})", "[]")),
                AllOf(at("/commands/0/brush/flow"), HasSubstr("(0, 1]")));
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 1})", R"([{"uv": [0, 0]}, {"uv": [0, 2]}])")),
                at("/commands/0/path/1/uv/1"));
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 1})",
                               R"([{"positionMm": [0, 0, 0], "normal": [0, 0, 0]}])")),
                at("/commands/0/path/0/normal"));
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 1})", R"([{"uv": [0, 0], "lifted": 1}])")),
                at("/commands/0/path/0/lifted: is 1, not true or false"));
    EXPECT_THAT(refusal(stroke(R"({"radiusMm": 1})", R"([{"pressure": 1}])")),
                at("/commands/0/path/0/positionMm: is missing"));
    EXPECT_THAT(refusal(withCommand(R"({"command": "select", "step": "grow", "distanceMm": 0})")),
                at("/commands/0/distanceMm"));
    EXPECT_THAT(refusal(withCommand(R"({"command": "select", "step": "all", "mode": "add"})")),
                at("/commands/0/mode: is an unknown field"));
}

TEST(StrokeFile, DeepNestingIsRefusedWithoutHarm) {
    EXPECT_THAT(refusal(std::string(200000, '[')), HasSubstr("nested deeper"));
    const std::string nested = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_THAT(refusal(withCommand(nested)), HasSubstr("nested deeper"));
}

} // namespace
} // namespace celadon::subedit
