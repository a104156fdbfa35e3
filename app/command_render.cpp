#include "app/command_render.h"

#include "renderer/output/atomic_file.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace celadon::app {
namespace {

/// Outputs that cannot be written are refused before the work, not after.
void checkOutputs(const RenderOptions& options) {
    checkWritable(outputOfFrame(options, options.frames ? options.frames->first : 0));
    if (options.stats) {
        checkWritable(*options.stats);
    }
}

} // namespace

Command addRenderCommand(CLI::App& root) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        root.add_subcommand("render", "Renders stills and sequences; no display is needed");
    addRenderOptions(*command, *options);
    return {command, [options] {
                validateRenderOptions(*options);
                checkOutputs(*options);
                render(*options);
            }};
}

void render(const RenderOptions& options) {
    static_cast<void>(options);
    throw Error("render", "not built yet", "", ExitCode::Failed);
}

} // namespace celadon::app
