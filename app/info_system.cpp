#include "app/command_info.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace celadon::app {
namespace {

void printProbe(const gl::ContextProbe& probe) {
    if (!probe.works) {
        fmt::print("{}: does not work ({})\n", probe.backend, probe.reason);
        return;
    }
    fmt::print("{}: works\n", probe.backend);
    fmt::print("  renderer  {}\n  version   {}\n  vendor    {}\n", probe.renderer, probe.version,
               probe.vendor);
    for (const auto& [name, value] : probe.limits) {
        fmt::print("  {} = {}\n", name, value);
    }
    fmt::print("  missing   {}\n", probe.missing.empty()
                                       ? "nothing"
                                       : fmt::format("{}", fmt::join(probe.missing, ", ")));
}

} // namespace

void describeSystem() {
    for (const gl::ContextProbe& probe : gl::probeContexts()) {
        printProbe(probe);
    }
}

} // namespace celadon::app
