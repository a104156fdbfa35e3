// Commands about files.
#include "renderer/scene/gltf_file.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/rewrite_gltf.h"
#include "renderer/scene/write_gltf.h"
#include "subedit/atomic_file.h"
#include "subedit/document/edit_progress.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/stop_point.h"
#include "ui/material_save.h"
#include "ui/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

/// Name of the file that a material goes into, beside the export.
std::string exportedName(const std::filesystem::path& file, int material) {
    return file.stem().string() + (material > 0 ? fmt::format("_{}", material + 1) : "") +
           ".subedit.exr";
}

/// The materials that are painted, as glTF has them.
std::vector<nlohmann::json> exportMaterials(const Session& session,
                                            const std::filesystem::path& file) {
    std::vector<nlohmann::json> materials;
    for (int i = 0; i < session.materialCount(); ++i) {
        const subedit::Document* const document = session.document(i);
        if (document == nullptr) {
            throw UsageError("export", fmt::format("material {} cannot be painted", i));
        }
        materials.push_back(
            session.services().describeMaterial(document->material(), exportedName(file, i)));
    }
    return materials;
}

/// What a glTF that is made of the world alone lacks.
std::vector<std::string> leftOut(const Session& session) {
    std::vector<std::string> lost;
    const World& world = session.world();
    if (world.rig != nullptr && !world.rig->animations.empty()) {
        lost.emplace_back("animations");
    }
    if (!world.cameras.empty()) {
        lost.emplace_back("cameras");
    }
    return lost;
}

/// Those that are on, in meters.
std::vector<loaders::NamedLight> exportLights(const Session& session) {
    constexpr double kMmPerMeter = 1e3;
    std::vector<loaders::NamedLight> lights;
    for (const RigLight& item : session.rig.lights) {
        if (item.isOn) {
            lights.push_back({item.name, item.light});
            lights.back().light.position /= kMmPerMeter;
        }
    }
    return lights;
}

/// A glTF that was opened keeps all that it has but for materials, deformers and lights, unless its
/// vertices had to change for an automatic atlas. Of other models a glTF is made.
void exportGltf(Session& session, const std::filesystem::path& name) {
    if (!session.hasWorld() || !session.services().describeMaterial) {
        throw UsageError("export", "there is no model", "open one first");
    }
    loaders::checkGltfName(name);
    const std::filesystem::path file = resolveTarget(name); // its materials lie beside it
    const std::filesystem::path model = session.opened().model;
    std::error_code ignored;
    if (std::filesystem::equivalent(model, file, ignored)) {
        throw UsageError(fmt::format("'{}'", file.string()), "is the model itself",
                         "choose another name");
    }
    const World& world = session.world();
    const std::vector<nlohmann::json> materials = exportMaterials(session, file);
    constexpr double kMmPerMeter = 1e3;
    const double metersPerUnit = world.millimetersPerUnit / kMmPerMeter;
    const DeformerStack stack = inUnits(session.motion.now.deformers, metersPerUnit);
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < session.materialCount(); ++i) {
        files.push_back(file.parent_path() / exportedName(file, i));
        if (session.beforeWriting) {
            session.beforeWriting(files.back());
        }
    }
    const auto writeMaterials = [&] { // after the glTF, which may be refused
        for (int i = 0; i < session.materialCount(); ++i) {
            subedit::stopPoint();
            subedit::writeMaterial(session.document(i)->material(),
                                   files[static_cast<std::size_t>(i)]);
        }
    };
    const subedit::EditProgress progress = session.progressOf("export");
    std::vector<std::string> lost;
    if (isGltf(model) && !world.hasAutomaticAtlas) {
        loaders::GltfChanges changes;
        for (const WorldMesh& part : world.meshes) {
            if (part.scattering >= 0) { // looks are numbered as in the file
                changes.materials[static_cast<std::size_t>(part.mesh.material)] =
                    materials[static_cast<std::size_t>(part.scattering)];
            }
        }
        changes.deformers = stack;
        changes.scale = metersPerUnit;
        if (session.areLightsOther()) {
            changes.lights = exportLights(session);
        }
        subedit::doTelling(progress, [&] {
            lost = loaders::rewriteGltf(model, changes, file);
            writeMaterials();
        });
        if (changes.lights && !world.lights.empty()) {
            lost.emplace_back("names, ranges and movements of lights");
        }
    } else {
        nlohmann::json extras = nlohmann::json::object();
        std::vector<loaders::NamedLight> lights;
        if (session.areLightsOther() || !world.lights.empty()) { // else those of any model
            lights = exportLights(session);
        }
        if (!stack.empty()) {
            extras["celadon"] = loaders::deformersJson(stack);
        }
        subedit::doTelling(progress, [&] {
            writeGltf(world, materials, extras, file, lights);
            writeMaterials();
        });
        lost = leftOut(session);
    }
    if (std::ranges::any_of(session.rig.lights, [](const RigLight& item) { return !item.isOn; })) {
        lost.emplace_back("lights that are off");
    }
    session.markLightsSaved();
    session.notify(Notice::Kind::Info,
                   fmt::format("Exported '{}' with {} beside it", file.string(),
                               materials.size() > 1 ? "its materials" : "its material"));
    if (!lost.empty()) {
        session.notify(Notice::Kind::Warning,
                       fmt::format("The export lacks {} of the model", fmt::join(lost, ", ")));
    }
}

double diameterOf(const Arguments& a) {
    const double mm = a.number("diameter");
    if (!(mm >= 1e-3 && mm <= 1e6)) {
        throw UsageError("size", fmt::format("{:g} mm is no size for a model", mm),
                         "choose one between 0.001 mm and 1 km");
    }
    return mm;
}

} // namespace

void addFileCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("file.open", "Opens a model, with a material or its own; diameter in mm",
                 [&session](const Arguments& a) {
                     OpenRequest request{a.text("model"), a.text("material", "")};
                     if (a.has("diameter")) {
                         request.diameterMm = diameterOf(a);
                     }
                     session.adopt(request, prepareScene(session.services().readWorld(request),
                                                         session.services().isPaintable));
                 });
    commands.addLong(
        "scene.size", "Makes the model so many mm large: diameter of its bounding sphere",
        [&session](const Arguments& a) { session.resize(diameterOf(a)); }, true);
    commands.addLong("file.export", "Writes a glTF with the materials as SubEdit files beside it",
                     [&session](const Arguments& a) {
                         exportGltf(session, a.text("file"));
                         session.dispatcher().announce({"file.export", {{"file", a.text("file")}}});
                     });
    commands.add("file.save",
                 "Writes a material to a .subedit.exr: file; material, if not the active one; name",
                 [&session](const Arguments& a) {
                     saveMaterial(session,
                                  {a.has("material")
                                       ? a.integerWithin("material", 0,
                                                         std::max(0, session.materialCount() - 1))
                                       : session.activeMaterial,
                                   a.text("file"), a.text("name", "")});
                 });
}

} // namespace celadon::ui
