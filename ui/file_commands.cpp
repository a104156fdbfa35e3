// Commands about files.
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/write_gltf.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "ui/session.h"

#include <fmt/format.h>

namespace celadon::ui {

namespace {

/// The same deformers in other model units. @param factor new units per old unit
DeformerStack inUnits(DeformerStack stack, double factor) {
    const auto scale = [factor](KeyedNumbers& numbers) {
        for (double& value : numbers.values) {
            value *= factor;
        }
    };
    for (AnimatedDeformer& deformer : stack) {
        for (LatticeMove& move : deformer.moves) {
            scale(move.by);
        }
        for (Handle& handle : deformer.handles) {
            handle.at *= factor;
            handle.radius *= factor;
            scale(handle.move);
        }
    }
    return stack;
}

void writeMaterialFile(const Session& session, const subedit::MaterialMap& material,
                       const std::filesystem::path& file) {
    if (session.beforeWriting) {
        session.beforeWriting(file);
    }
    subedit::writeMaterial(material, file);
}

/// FILE.gltf, FILE.bin, and a material file for each material that is worn.
void exportGltf(Session& session, const std::filesystem::path& file) {
    if (!session.hasWorld() || !session.services().describeMaterial) {
        throw UsageError("export", "there is no model", "open one first");
    }
    if (file.extension() != ".gltf") {
        throw UsageError(fmt::format("'{}'", file.string()), "is no name of a glTF",
                         "let it end in .gltf");
    }
    std::vector<nlohmann::json> materials;
    for (int i = 0; i < session.materialCount(); ++i) {
        const subedit::Document* const document = session.document(i);
        if (document == nullptr) {
            throw UsageError("export", fmt::format("material {} cannot be painted", i));
        }
        const std::string name =
            file.stem().string() + (i > 0 ? fmt::format("_{}", i + 1) : "") + ".subedit.exr";
        writeMaterialFile(session, document->material(), file.parent_path() / name);
        materials.push_back(session.services().describeMaterial(document->material(), name));
    }
    nlohmann::json extras = nlohmann::json::object();
    if (const DeformerStack& stack = session.motion.now.deformers; !stack.empty()) {
        constexpr double kMmPerMeter = 1e3;
        extras["celadon"] = loaders::deformersJson(
            inUnits(stack, session.world().millimetersPerUnit / kMmPerMeter));
    }
    writeGltf(session.world(), materials, extras, file);
    session.notify(Notice::Kind::Info,
                   fmt::format("Exported '{}' with {} beside it", file.string(),
                               materials.size() > 1 ? "its materials" : "its material"));
}

} // namespace

void addFileCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("file.open", "Opens a model, with a material or its own",
                 [&session](const Arguments& a) {
                     const OpenRequest request{a.text("model"), a.text("material", "")};
                     session.adopt(request, prepareScene(session.services().readWorld(request),
                                                         session.services().isPaintable));
                 });
    commands.add("file.export", "Writes a glTF with the materials as SubEdit files beside it",
                 [&session](const Arguments& a) { exportGltf(session, a.text("file")); });
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
                     writeMaterialFile(session, document->material(), file);
                     session.materialFile = file;
                     session.markSaved();
                     session.notify(Notice::Kind::Info, fmt::format("Saved '{}'", file.string()));
                 });
}

} // namespace celadon::ui
