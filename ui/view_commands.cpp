// Commands about how the picture is shown.
#include "subedit/errors.h"
#include "ui/session.h"
#include "ui/view_names.h"

namespace celadon::ui {

void addViewCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    const auto add = [&](const char* name, const char* summary, Dispatcher::Handler handler) {
        commands.add(name, summary, [&session, handler = std::move(handler)](const Arguments& a) {
            handler(a);
            session.touchPicture();
        });
    };
    add("view.exposure", "Brightness of the picture in stops (EV)", [&session](const Arguments& a) {
        session.view.exposureEv = static_cast<float>(a.numberWithin("ev", -20.0, 20.0));
    });
    add("view.tonemap", "Tone curve: neutral, aces, none",
        [&session](const Arguments& a) { session.view.toneMap = parseToneMap(a.text("name")); });
    add("view.specular", "Highlights on or off",
        [&session](const Arguments& a) { session.view.specular = a.flag("on"); });
    add("view.mode",
        "What the viewport shows, by name; level (a mip), light (by number), distance in mm",
        [&session](const Arguments& a) {
            session.view.mode.mode = parseViewMode(a.text("name"));
            if (a.has("level")) {
                session.view.mode.level = a.integerWithin("level", 0, 11);
            }
            if (a.has("light")) {
                session.view.mode.light = a.integerWithin("light", 0, 1 << 20);
            }
            if (a.has("distance")) {
                session.view.mode.distanceMm =
                    static_cast<float>(a.numberWithin("distance", 0.0, 1e6));
            }
        });
}

} // namespace celadon::ui
