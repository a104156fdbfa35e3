#include "app/command_info.h"
#include "subedit/errors.h"

namespace celadon::app {

void describeFile(const InfoOptions& options) {
    throw Error("'" + options.file + "'", "info about files is not built yet", "",
                ExitCode::Failed);
}

} // namespace celadon::app
