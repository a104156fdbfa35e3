// Commands about the two profiles in hand. Radii in mm, P in 1/mm^2.
#include "subedit/edit/profile_editor.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "ui/model_profile.h"
#include "ui/session.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <utility>

namespace celadon::ui {

namespace {

bool isSecondary(const Arguments& a) {
    const std::string which = a.text("which", "primary");
    if (which != "primary" && which != "secondary") {
        throw UsageError("profile", fmt::format("'{}' is neither primary nor secondary", which));
    }
    return which == "secondary";
}

NamedProfile& profileOf(Session& session, const Arguments& a) {
    return isSecondary(a) ? session.paint.secondary : session.paint.primary;
}

/// A step that can be undone.
void change(Session& session, const Arguments& a, NamedProfile next, const char* title) {
    session.changeProfile(isSecondary(a), std::move(next), title, a.flag("continues", false));
}

subedit::ProfileLayout layoutOf(const subedit::StoredProfile& profile) {
    return {profile.segments, profile.maxRadiusMm};
}

/// No more light than came in, whatever was asked. Knots at the floor stay there, so that scaling
/// the rest takes a few rounds.
void limitAlbedo(subedit::StoredProfile& profile) {
    constexpr int kRounds = 10;
    constexpr auto kLargest = static_cast<double>(subedit::kLargestAlbedo);
    for (int round = 0; round < kRounds; ++round) {
        const glm::dvec3 shift =
            glm::max(glm::log(subedit::diffuseAlbedo(profile.view()) / kLargest), glm::dvec3(0.0));
        if (shift == glm::dvec3(0.0)) {
            return;
        }
        for (std::size_t i = 0; i < profile.logProfile.size(); ++i) {
            float& logP = profile.logProfile[i];
            logP = std::max(logP - static_cast<float>(shift[static_cast<int>(i % 3)]),
                            subedit::kLogProfileFloor);
        }
    }
}

/// Changes a profile by albedo or range.
void changeProfile(subedit::StoredProfile& profile, const Arguments& a) {
    subedit::ProfileEditor editor(layoutOf(profile));
    editor.load(profile.logProfile.data());
    if (a.has("albedo")) {
        const glm::vec3 albedo(a.vector3("albedo"));
        for (int c = 0; c < 3; ++c) {
            editor.setAlbedo(c, glm::clamp(albedo[c], 0.0f, subedit::kLargestAlbedo));
        }
    }
    if (a.has("radius")) {
        const glm::vec3 radius(a.vector3("radius"));
        glm::vec3 scale(1.0f);
        for (int c = 0; c < 3; ++c) {
            const float now = editor.radiusMm(c, 0.95f);
            if (now > 0.0f && radius[c] > 0.0f) {
                scale[c] = radius[c] / now;
            }
        }
        editor.scaleRange(scale);
    }
    profile.logProfile.assign(editor.result(), editor.result() + layoutOf(profile).values());
    limitAlbedo(profile);
}

void moveKnot(subedit::StoredProfile& profile, const Arguments& a) {
    const int knot = a.integerWithin("knot", 0, profile.segments);
    const int channel = a.integerWithin("channel", 0, 2);
    const auto value = static_cast<float>(
        a.numberWithin("log", static_cast<double>(subedit::kLogProfileFloor), 10.0));
    subedit::ProfileEditor editor(layoutOf(profile));
    editor.load(profile.logProfile.data());
    editor.values()[knot * 3 + channel] = value;
    profile.logProfile.assign(editor.result(), editor.result() + layoutOf(profile).values());
    limitAlbedo(profile);
}

} // namespace

void addProfileCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("profile.swap", "Primary becomes secondary and the other way round",
                 [&session](const Arguments&) { session.swapProfiles(); });
    commands.add(
        "profile.pick", "Takes the profile at a place of the map: uv",
        [&session](const Arguments& a) {
            const subedit::Document* const document = session.document(
                a.integerWithin("material", 0, std::max(0, session.materialCount() - 1)));
            if (document == nullptr) {
                throw UsageError("profile", "there is no material to pick from");
            }
            change(session, a,
                   {"Picked", storedProfileAt(document->material(), glm::vec2(a.vector2("uv")))},
                   "pick profile");
        });
    commands.add("profile.medium", "Takes the profile of a homogeneous material, by file or name",
                 [&session](const Arguments& a) {
                     const std::string name = a.text("name");
                     const subedit::MaterialMap map =
                         subedit::readMaterial(subedit::findMaterial(name));
                     change(session, a,
                            {map.name.empty() ? name : map.name,
                             storedProfile(map, map.width / 2, map.height / 2)},
                            "profile of a material");
                 });
    commands.add(
        "profile.diffusion", "Normalized diffusion with an albedo and radii R_P in mm",
        [&session](const Arguments& a) {
            change(session, a,
                   {a.text("name", "Custom"),
                    diffusionProfile(glm::clamp(glm::vec3(a.vector3("albedo")), 0.0f, 0.999f),
                                     glm::clamp(glm::vec3(a.vector3("radius")), 1e-3f, 1e3f))},
                   "profile by diffusion");
        });
    commands.add("profile.model", "A published model's profile: model, albedo, radii R_P in mm",
                 [&session](const Arguments& a) {
                     const subedit::Document* const document = session.activeDocument();
                     const double eta =
                         document != nullptr ? static_cast<double>(document->material().eta) : 1.3;
                     change(
                         session, a,
                         {a.text("name", "Custom"),
                          modelProfile(a.text("model"), glm::clamp(a.vector3("albedo"), 0.0, 0.999),
                                       glm::clamp(a.vector3("radius"), 1e-3, 1e3), eta)},
                         "profile by a model");
                 });
    commands.add("profile.change", "Changes albedo or radii R_P (mm) per channel",
                 [&session](const Arguments& a) {
                     NamedProfile changed = profileOf(session, a);
                     changeProfile(changed.profile, a);
                     change(session, a, std::move(changed), "change profile");
                 });
    commands.add("profile.knot", "Moves one knot of a channel: log is ln P, P in 1/mm^2",
                 [&session](const Arguments& a) {
                     NamedProfile changed = profileOf(session, a);
                     moveKnot(changed.profile, a);
                     change(session, a, std::move(changed), "move knot");
                 });
}

} // namespace celadon::ui
