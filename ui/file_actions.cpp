#include "ui/file_actions.h"

#include "renderer/scene/load_deformers.h"
#include "subedit/errors.h"
#include "ui/file_names.h"
#include "ui/user_folders.h"
#include "ui/window.h"

#include <fmt/format.h>

#include <utility>

namespace celadon::ui {

namespace {

constexpr const char* kMaterialSuffix = ".subedit.exr";

} // namespace

FileActions::FileActions(Session& session, BackgroundOpen& open, Preferences& preferences,
                         bool isUnattended)
    : mSession(session),
      mOpen(open),
      mPreferences(preferences),
      mIsUnattended(isUnattended),
      mSave(session, [] { Window::wake(); }) {}

void FileActions::open(const OpenRequest& request) {
    const std::function<void()> act = [this, request] { mOpen.start(request); };
    if (request.model == mSession.opened().model) { // which keeps its deformers
        guardMaterial(act);
    } else {
        guard(act);
    }
}

void FileActions::putOn(const std::string& material) {
    OpenRequest request = mSession.opened();
    request.material = material;
    request.readInstead.clear();
    open(request);
}

void FileActions::openModel() {
    choose(FileDialog::Kind::Open, "Open a model",
           {".gltf", ".glb", ".obj", ".ply", ".off", ".stl"}, "", [this](const auto& file) {
               open({file.string(), {}});
           });
}

void FileActions::openMaterial() {
    choose(FileDialog::Kind::Open, "Open a material", {kMaterialSuffix}, "",
           [this](const auto& file) { putOn(file.string()); });
}

void FileActions::openEnvironment() {
    choose(FileDialog::Kind::Open, "Open an environment", {".hdr", ".exr"}, "",
           [this](const auto& file) {
               mSession.perform({"environment.open", {{"file", file.string()}}});
           });
}

void FileActions::openStamp() {
    choose(FileDialog::Kind::Open, "Open an image to stamp",
           {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".hdr"}, "",
           [this](const auto& file) {
               mSession.perform({"stamp.open", {{"file", file.string()}}});
           });
}

void FileActions::openDeformers() {
    choose(FileDialog::Kind::Open, "Open deformers", {".json"}, "",
           [this](const auto& file) { replaceDeformers(file); });
}

void FileActions::replaceDeformers(const std::filesystem::path& file) {
    try {
        const Command command{"deform.stack", loaders::deformersJson(loaders::readDeformers(file))};
        mSession.performLong([this, command] {
            mSession.execute(command);
            mSession.markDeformersSaved();
        });
    } catch (const Error& error) {
        mSession.notify(Notice::Kind::Error, error.what());
    }
}

void FileActions::saveDeformers(const std::function<void()>& then) {
    const std::string model = std::filesystem::path(mSession.opened().model).extension().string();
    std::vector<std::string> suffixes{".json"};
    if (model == ".glb" || model == ".gltf") {
        suffixes.push_back(model);
    }
    choose(FileDialog::Kind::Save, "Save the deformers", suffixes, "deformers.json",
           [this, then](const auto& file) {
               if (mSession.perform({"deform.save", {{"file", file.string()}}}) && then) {
                   then();
               }
           });
}

void FileActions::saveTo(const MaterialSave& save, const std::function<void()>& then) {
    if (mIsUnattended) {
        if (mSession.perform(saveCommand(save)) && then) {
            then();
        }
        return;
    }
    mSave.start(save, [this, file = save.file, then] {
        addRecent(mPreferences.recentMaterials, file.string());
        savePreferences();
        if (then) {
            then();
        }
    });
}

void FileActions::saveAs(int material, const std::function<void()>& then) {
    const subedit::Document* const document = mSession.document(material);
    if (document == nullptr) {
        return;
    }
    const std::filesystem::path& file = mSession.materialFile(material);
    const std::string& label = document->material().name;
    choose(FileDialog::Kind::Save,
           mSession.materialCount() > 1 ? fmt::format("Save material {}, {}", material + 1, label)
                                        : "Save the material",
           {kMaterialSuffix}, file.empty() ? std::filesystem::path(label + kMaterialSuffix) : file,
           [this, material, then](const auto& chosen) {
               saveTo({material, chosen, {}}, then);
           });
}

void FileActions::saveFrom(int material, const std::function<void()>& then) {
    while (material < mSession.materialCount() && !mSession.isModified(material)) {
        ++material;
    }
    if (material >= mSession.materialCount()) {
        if (then) {
            then();
        }
        return;
    }
    const auto next = [this, material, then] { saveFrom(material + 1, then); };
    if (mSession.materialFile(material).empty()) {
        saveAs(material, next);
    } else {
        saveTo({material, mSession.materialFile(material), {}}, next);
    }
}

void FileActions::save(const std::function<void()>& then) {
    const int active = mSession.activeMaterial;
    if (mSession.isModified() || mSession.document(active) == nullptr) {
        saveFrom(0, then);
    } else if (mSession.materialFile(active).empty()) {
        saveAs(active, then);
    } else {
        saveTo({active, mSession.materialFile(active), {}}, then);
    }
}

void FileActions::saveAsNew(const std::string& name) {
    const std::filesystem::path folder = dataFolder() / "materials";
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    const std::filesystem::path file = folder / (name + kMaterialSuffix);
    if (!std::filesystem::exists(file, failed)) {
        saveTo({mSession.activeMaterial, file, name}, {});
        return;
    }
    ask("Replace?", fmt::format("There is a material '{}' already.", name),
        {{"Replace",
          [this, file, name] {
              saveTo({mSession.activeMaterial, file, name}, {});
          }},
         {"Cancel", {}}});
}

void FileActions::exportGltf(const std::function<void()>& then) {
    const std::string stem = std::filesystem::path(mSession.opened().model).stem().string();
    chooseOutput("Export glTF and SubEdit", {".gltf", ".glb"},
                 (stem.starts_with("builtin:") ? stem.substr(8) : stem) + ".gltf",
                 [this, then](const auto& file) {
                     if (mSession.perform({"file.export", {{"file", file.string()}}}) && then) {
                         then();
                     }
                 });
}

void FileActions::chooseOutput(const std::string& title, std::vector<std::string> suffixes,
                               const std::string& name,
                               std::function<void(const std::filesystem::path&)> done) {
    choose(FileDialog::Kind::Save, title, std::move(suffixes), name, std::move(done));
}

void FileActions::choose(FileDialog::Kind kind, const std::string& title,
                         std::vector<std::string> suffixes, const std::filesystem::path& proposed,
                         std::function<void(const std::filesystem::path&)> done) {
    std::filesystem::path& last = kind == FileDialog::Kind::Save ? mSavedTo : mOpenedFrom;
    std::filesystem::path folder = proposed.has_parent_path() ? proposed.parent_path() : last;
    if (folder.empty() && !mSession.opened().model.starts_with("builtin:")) {
        folder = std::filesystem::path(mSession.opened().model).parent_path();
    }
    mFiles.open(kind, title, std::move(suffixes), folder, proposed.filename().string(),
                [&last, done = std::move(done)](const std::filesystem::path& file) {
                    last = file.parent_path();
                    done(file);
                });
}

void FileActions::drop(const std::filesystem::path& file) {
    const std::string name = lowered(file.filename().string());
    if (name.ends_with(kMaterialSuffix)) {
        putOn(file.string());
    } else if (name.ends_with(".hdr") || name.ends_with(".exr")) {
        mSession.perform({"environment.open", {{"file", file.string()}}});
    } else if (name.ends_with(".png") || name.ends_with(".jpg") || name.ends_with(".jpeg")) {
        mSession.perform({"stamp.open", {{"file", file.string()}}});
    } else if (name.ends_with(".json")) {
        replaceDeformers(file);
    } else {
        open({file.string(), {}});
    }
}

void FileActions::guard(const std::function<void()>& act) {
    guardMaterial([this, act] { guardDeformers([this, act] { guardLights(act); }); });
}

void FileActions::askToSave(const std::string& text, Question::Answer saving,
                            const std::function<void()>& act) {
    ask("Unsaved changes", text,
        {std::move(saving),
         {"Do not save", act}, // still modified, should opening fail
         {"Cancel", {}}});
}

void FileActions::guardLights(const std::function<void()>& act) {
    if (!mSession.areLightsModified() || mIsUnattended) {
        act();
        return;
    }
    askToSave("The lights have changes that only an export to glTF keeps.",
              {"Export\xe2\x80\xa6", [this, act] { exportGltf(act); }}, act);
}

void FileActions::guardDeformers(const std::function<void()>& act) {
    if (!mSession.areDeformersModified() || mIsUnattended) {
        act();
        return;
    }
    askToSave("The deformers have changes that are not saved.",
              {"Save\xe2\x80\xa6", [this, act] { saveDeformers(act); }}, act);
}

void FileActions::guardMaterial(const std::function<void()>& act) {
    mSave.wait(); // what is being written may be all that there is to ask about
    if (!mSession.isModified() || mIsUnattended) {
        act();
        return;
    }
    askAboutMaterial(act);
}

void FileActions::askAboutMaterial(const std::function<void()>& act) {
    askToSave(mSession.materialCount() > 1 ? "Materials have changes that are not saved."
                                           : "The material has changes that are not saved.",
              {"Save\xe2\x80\xa6", [this, act] { save([this, act] { guardMaterial(act); }); }},
              act);
}

void FileActions::remember(const OpenRequest& opened) {
    if (mIsUnattended) {
        return;
    }
    addRecent(mPreferences.recentModels, opened.model);
    if (opened.material.ends_with(kMaterialSuffix)) {
        addRecent(mPreferences.recentMaterials, opened.material);
    }
    savePreferences();
}

void FileActions::savePreferences() {
    try {
        writePreferences(mPreferences, preferencesFile());
    } catch (const Error& error) {
        mSession.notify(Notice::Kind::Warning, error.what());
    }
}

void FileActions::draw(float scale) {
    mFiles.draw(scale);
    mQuestion.draw(scale);
}

} // namespace celadon::ui
