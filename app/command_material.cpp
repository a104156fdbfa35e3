#include "app/command_material.h"

#include "app/command_material_edit.h"
#include "app/material/material_commands.h"

#include <CLI/CLI.hpp>

namespace celadon::app {

Command addMaterialCommand(CLI::App& root) {
    CLI::App* material =
        root.add_subcommand("material", "Makes, edits and describes SubEdit materials");
    return {material,
            {},
            {addMaterialBake(*material), addMaterialInfo(*material), addMaterialEdit(*material),
             addMaterialConvert(*material), addMaterialFit(*material), addMaterialImport(*material),
             addMaterialExport(*material)}};
}

} // namespace celadon::app
