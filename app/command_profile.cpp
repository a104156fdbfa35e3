#include "app/command_profile.h"

#include "app/profile/profile_commands.h"

#include <CLI/CLI.hpp>

namespace celadon::app {

Command addProfileCommand(CLI::App& root) {
    CLI::App* profile =
        root.add_subcommand("profile", "Computes scattering profiles and their tables");
    return {profile,
            {},
            {addProfileMake(*profile), addProfileFit(*profile), addProfileTable(*profile),
             addProfilePlot(*profile), addProfileLut(*profile), addProfileList(*profile)}};
}

} // namespace celadon::app
