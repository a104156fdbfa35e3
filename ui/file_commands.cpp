// Commands about files.
#include "ui/session.h"

namespace celadon::ui {

void addFileCommands(Session& session) {
    session.dispatcher().add("file.open", "Opens a model, with a material or its own",
                             [&session](const Arguments& a) {
                                 const OpenRequest request{a.text("model"), a.text("material", "")};
                                 session.adopt(request, session.services().readWorld(request));
                             });
}

} // namespace celadon::ui
