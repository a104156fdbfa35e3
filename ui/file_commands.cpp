// Commands about files.
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "ui/session.h"

#include <fmt/format.h>

namespace celadon::ui {

void addFileCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("file.open", "Opens a model, with a material or its own",
                 [&session](const Arguments& a) {
                     const OpenRequest request{a.text("model"), a.text("material", "")};
                     session.adopt(request, prepareScene(session.services().readWorld(request),
                                                         session.services().isPaintable));
                 });
    commands.add("file.save", "Writes the material that is worked on to a .subedit.exr",
                 [&session](const Arguments& a) {
                     const subedit::Document* const document = session.activeDocument();
                     if (document == nullptr) {
                         throw UsageError("save", "there is no material", "open a model first");
                     }
                     const std::filesystem::path file = a.text("file");
                     if (!file.filename().string().ends_with(".subedit.exr")) {
                         throw UsageError(fmt::format("'{}'", file.string()),
                                          "is no name of a material", "let it end in .subedit.exr");
                     }
                     subedit::writeMaterial(document->material(), file);
                     session.materialFile = file;
                     session.markSaved();
                     session.notify(Notice::Kind::Info, fmt::format("Saved '{}'", file.string()));
                 });
}

} // namespace celadon::ui
