#include "app/command_info.h"
#include "subedit/errors.h"

#include <fmt/format.h>

namespace celadon::app {

void describeFile(const InfoOptions& options) {
    throw Error(fmt::format("'{}'", options.file), "info about files is not built yet", "",
                ExitCode::Failed);
}

} // namespace celadon::app
