// Commands that move the camera. Lengths in mm, angles in degrees.
#include "ui/camera_controller.h"
#include "ui/session.h"

#include <glm/vec3.hpp>

namespace celadon::ui {

void addCameraCommands(Session& session) {
    const auto change = [&session](const Camera& camera) {
        validateCamera(camera);
        session.camera = camera;
        session.touchPicture();
    };
    Dispatcher& commands = session.dispatcher();
    commands.add("camera.orbit", "Turns about the target: azimuth and elevation in degrees",
                 [&session, change](const Arguments& a) {
                     change(orbited(session.camera, a.number("azimuth"), a.number("elevation")));
                 });
    commands.add(
        "camera.turntable",
        "Turns camera and lights together about the target, so that the object turns: degrees",
        [&session, change](const Arguments& a) {
            change(session.turnLights(a.number("degrees")));
        });
    commands.add("camera.pan", "Shifts the view: right and up in mm",
                 [&session, change](const Arguments& a) {
                     change(panned(session.camera, a.number("right"), a.number("up")));
                 });
    commands.add(
        "camera.zoom", "Scales the distance to a point: factor, point in mm",
        [&session, change](const Arguments& a) {
            change(zoomed(session.camera, a.numberWithin("factor", 1e-3, 1e3), a.vector3("point")));
        });
    commands.add(
        "camera.frame", "Fits the object into the view", [&session, change](const Arguments& a) {
            if (session.hasWorld()) {
                change(framed(session.camera, session.world(), a.number("aspect", session.aspect)));
            }
        });
    commands.add("camera.view", "Looks from a side: front, back, right, left, top, bottom, initial",
                 [&session, change](const Arguments& a) {
                     const std::string name = a.text("name");
                     if (name == "initial" && session.fileCamera) {
                         change(*session.fileCamera);
                     } else {
                         change(standardView(session.camera, name));
                     }
                 });
    commands.add("camera.projection", "Orthographic or perspective",
                 [&session, change](const Arguments& a) {
                     change(withProjection(session.camera, a.flag("orthographic")));
                 });
    commands.add("camera.lens", "Vertical field of view in degrees",
                 [&session, change](const Arguments& a) {
                     Camera camera = session.camera;
                     camera.fovYDegrees = a.numberWithin("degrees", 1.0, 150.0);
                     change(camera);
                 });
    commands.add("camera.place", "Eye and target in mm", [&session, change](const Arguments& a) {
        Camera camera = session.camera;
        camera.eye = a.vector3("eye");
        camera.at = a.vector3("at");
        camera.up = {0.0, 1.0, 0.0};
        change(camera);
    });
}

} // namespace celadon::ui
