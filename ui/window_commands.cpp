#include "ui/window_commands.h"

#include "subedit/errors.h"
#include "ui/layout.h"
#include "ui/picture_file.h"
#include "ui/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace celadon::ui {

namespace {

/// What concerns the window only, so that replays can show every panel. Not recorded: how the
/// window looks changes nothing of the work.
void addLooks(Dispatcher& commands, const WindowTargets& t) {
    const auto add = [&commands](const char* name, const char* summary,
                                 Dispatcher::Handler handler) {
        commands.add(name, summary, std::move(handler), false);
    };
    add("window.tab", "Shows a tab of the side bar: brush, profile, material, light, deform, view",
        [t](const Arguments& a) { t.layout.tab = parseTab(a.text("name")); });
    add("window.show", "Shows or hides panels, help, preferences", [t](const Arguments& a) {
        t.layout.panelsShown = a.flag("panels", t.layout.panelsShown);
        t.layout.helpShown = a.flag("help", t.layout.helpShown);
        t.layout.preferencesShown = a.flag("preferences", t.layout.preferencesShown);
    });
    add("window.scroll", "Scrolls the side bar, 0 top to 1 bottom",
        [t](const Arguments& a) { t.layout.scrollTo = a.numberWithin("to", 0.0, 1.0); });
    add("window.act",
        "What the key of an action does: action, by its name in the preferences' file",
        [t](const Arguments& a) { t.act(parseAction(a.text("action"))); });
    add("window.dialog", "Opens a dialog: open, save, unsaved", [t](const Arguments& a) {
        const std::string name = a.text("name");
        if (name == "unsaved") {
            t.files.askAboutMaterial([] {});
        } else {
            name == "save" ? t.files.saveAs() : t.files.openModel();
        }
    });
    add("window.menu", "Opens a menu: file, edit, view, help; none closes them",
        [t](const Arguments& a) { t.layout.openMenu = a.text("name"); });
    add("window.drop", "As if a file were dropped on the window: file",
        [t](const Arguments& a) { t.files.drop(a.text("file")); });
    add("window.cursor", "Where the tools take the cursor to be, of the viewport: 0,0 top left",
        [t](const Arguments& a) { t.tools.pretend(a.vector2("place")); });
}

/// What is written of the pictures: recorded, as all that leaves something.
void addExports(Session& session, const WindowTargets& t) {
    Dispatcher& commands = session.dispatcher();
    commands.add("export.picture", "The picture in the viewport, as it is: file",
                 [&session, t](const Arguments& a) {
                     const std::string file = a.text("file");
                     if (t.viewport.shownRung() < 0) {
                         throw UsageError("export.picture", "there is no picture yet");
                     }
                     writePicture(file, t.viewport.texture());
                     session.notify(Notice::Kind::Info, fmt::format("Saved '{}'", file));
                 });
    commands.add("export.turntable", "Pictures of a whole turn: file, frames, size in pixels",
                 [&session, t](const Arguments& a) {
                     TurntableSettings settings;
                     settings.file = a.text("file");
                     settings.frames = a.integerWithin("frames", 1, 10000);
                     if (a.has("size")) {
                         settings.sizePx = glm::ivec2(a.vector2("size"));
                         if (std::min(settings.sizePx.x, settings.sizePx.y) < 16 ||
                             std::max(settings.sizePx.x, settings.sizePx.y) > 8192) {
                             throw UsageError("export.turntable, size",
                                              "is not within 16 to 8192 pixels");
                         }
                     }
                     startTurntable(session, t.jobs, settings);
                 });
}

} // namespace

void addWindowCommands(Session& session, const WindowTargets& targets) {
    addLooks(session.dispatcher(), targets);
    addExports(session, targets);
}

} // namespace celadon::ui
