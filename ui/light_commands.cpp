// Commands about lights. Directional: irradiance in W/m^2; point and spot: W/sr; positions in mm.
#include "renderer/scene/environment.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <utility>

namespace celadon::ui {

namespace {

RigLight& lightAt(Session& session, const Arguments& a) {
    const int count = static_cast<int>(session.rig.lights.size());
    if (count == 0) {
        throw UsageError("lights", "there is none", "add one");
    }
    return session.rig.lights[static_cast<std::size_t>(a.integerWithin("light", 0, count - 1))];
}

const BoundingSphere& object(const Session& session) {
    if (!session.hasWorld()) {
        throw UsageError("lights", "no model is open", "open one first");
    }
    return session.world().scatteringSphere;
}

RigEnvironment& environmentOf(Session& session) {
    if (!session.rig.environment) {
        throw UsageError("environment", "none is open", "open a .hdr or .exr first");
    }
    return *session.rig.environment;
}

void changeLight(RigLight& item, const Arguments& a) {
    Light changed = item.light;
    if (a.has("color")) {
        changed.color = a.vector3("color");
        if (glm::any(glm::lessThan(changed.color, glm::dvec3(0.0)))) {
            throw UsageError("light", "its color is negative");
        }
    }
    if (a.has("direction")) {
        const glm::dvec3 direction = a.vector3("direction");
        if (!(glm::length(direction) > 0.0)) {
            throw UsageError("light", "its direction is zero");
        }
        changed.direction = glm::normalize(direction);
    }
    if (a.has("position")) {
        changed.position = a.vector3("position");
    }
    if (a.has("inner") || a.has("outer")) {
        const double inner = a.has("inner") ? a.numberWithin("inner", 0.0, 90.0)
                                            : glm::degrees(changed.innerConeRadians);
        const double outer = a.has("outer") ? a.numberWithin("outer", 0.1, 90.0)
                                            : glm::degrees(changed.outerConeRadians);
        changed.outerConeRadians = glm::radians(outer);
        changed.innerConeRadians = glm::radians(std::min(inner, outer - 0.05));
    }
    if (a.has("direction") || a.has("position")) {
        item.followed.reset();
    }
    item.light = changed;
    item.isOn = a.flag("on", item.isOn);
    item.name = a.text("name", item.name);
}

} // namespace

void addLightCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    // Each is a step that can be undone.
    const auto add = [&](const char* name, const char* summary, const char* title,
                         Dispatcher::Handler handler) {
        commands.add(name, summary,
                     [&session, title, handler = std::move(handler)](const Arguments& a) {
                         LightRig before = session.rig;
                         handler(a);
                         session.changeLights(std::exchange(session.rig, std::move(before)), title,
                                              a.flag("continues", false));
                     });
    };
    add("light.preset", "Replaces the lights: back, rim, studio, front", "light preset",
        [&session](const Arguments& a) {
            session.rig.lights = lightPreset(a.text("name"), session.camera, object(session));
            session.selectedLight = 0;
        });
    add("light.add", "Adds a light: directional, point, spot", "add light",
        [&session](const Arguments& a) {
            session.rig.lights.push_back(newLight(parseLightKind(a.text("kind")), session.camera,
                                                  object(session), session.rig.lights));
            session.selectedLight = static_cast<int>(session.rig.lights.size()) - 1;
        });
    add("light.remove", "Removes a light", "remove light", [&session](const Arguments& a) {
        static_cast<void>(lightAt(session, a));
        const int index = a.integerWithin("light", 0, 1 << 20);
        session.rig.lights.erase(session.rig.lights.begin() + index);
        session.selectedLight =
            std::max(0, std::min(session.selectedLight, int(session.rig.lights.size()) - 1));
    });
    add("light.change", "Changes color, direction, position, cones (degrees), name or on",
        "change light", [&session](const Arguments& a) { changeLight(lightAt(session, a), a); });
    add("light.move", "Drags a light to a point in mm; it goes on aiming at the object",
        "move light", [&session](const Arguments& a) {
            RigLight& item = lightAt(session, a);
            item.followed.reset();
            item.light = movedTo(item.light, a.vector3("position"), object(session));
        });
    commands.add(
        "light.select", "Chooses the light that the panel shows",
        [&session](const Arguments& a) {
            static_cast<void>(lightAt(session, a));
            session.selectedLight = a.integerWithin("light", 0, 1 << 20);
        },
        false);
    add("environment.open", "Light from all around: a .hdr or .exr", "open environment",
        [&session](const Arguments& a) {
            const std::filesystem::path file = a.text("file");
            auto map = std::make_shared<EnvironmentMap>(readEnvironment(file));
            for (const std::string& warning : map->warnings) {
                session.notify(Notice::Kind::Warning, warning);
            }
            RigEnvironment environment;
            environment.file = file;
            environment.map = std::move(map);
            session.rig.environment = environment;
        });
    add("environment.change", "Strength, turn in degrees, number of lights", "change environment",
        [&session](const Arguments& a) {
            RigEnvironment changed = environmentOf(session);
            if (a.has("strength")) {
                changed.strength = a.numberWithin("strength", 0.0, 1e6);
            }
            if (a.has("turn")) {
                changed.turnDegrees = a.numberWithin("turn", -360.0, 360.0);
            }
            if (a.has("lights")) {
                changed.lights = a.integerWithin("lights", 1, 256);
            }
            session.rig.environment = changed;
        });
    add("environment.close", "No light from the environment", "remove environment",
        [&session](const Arguments&) { session.rig.environment.reset(); });
}

} // namespace celadon::ui
