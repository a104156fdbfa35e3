#include "app/command_material.h"
#include "app/command_profile.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    CLI::App app("Paint translucency, see the light", "celadon");
    app.require_subcommand(1);
    celadon::addProfileCommand(app);
    celadon::addMaterialCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(celadon::ExitCode::Usage);
    } catch (const celadon::Error& error) {
        fmt::print(stderr, "celadon: {}\n", error.what());
        return static_cast<int>(error.exitCode());
    } catch (const std::exception& error) {
        fmt::print(stderr, "celadon: {}\n", error.what());
        return static_cast<int>(celadon::ExitCode::Failed);
    }
    return 0;
}
