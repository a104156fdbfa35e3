#pragma once

#include "ui/background_open.h"
#include "ui/material_save.h"
#include "ui/panels/file_dialog.h"
#include "ui/panels/question.h"
#include "ui/preferences.h"
#include "ui/session.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Opening and saving as a user does it: dialogs, drops, recent files, and the guard that no
/// unsaved change is lost without a word.
namespace celadon::ui {

class FileActions {
public:
    /// @param isUnattended nobody is there to answer questions: nothing is asked or remembered
    FileActions(Session& session, BackgroundOpen& open, Preferences& preferences,
                bool isUnattended);

    void open(const OpenRequest& request);
    /// On the model that is open, as large as it is.
    void putOn(const std::string& material);
    void openModel();
    void openMaterial();
    void openEnvironment();
    void openStamp();
    void openDeformers();
    /// @param then once they are saved
    void saveDeformers(const std::function<void()>& then = {});
    /// All materials that are modified; the active one if none is. @param then once they are saved
    void save(const std::function<void()>& then = {});
    /// The active material, under another name.
    void saveAs() { saveAs(mSession.activeMaterial, {}); }
    /// Into the user's own materials. @param name without a suffix
    void saveAsNew(const std::string& name);
    void exportGltf(const std::function<void()>& then = {});
    /// Any other output: the dialog, and where to write.
    void chooseOutput(const std::string& title, std::vector<std::string> suffixes,
                      const std::string& name,
                      std::function<void(const std::filesystem::path&)> done);
    /// A file that was dropped on the window: a model, a material or an environment.
    void drop(const std::filesystem::path& file);

    /// Acts, after asking where changes would be lost.
    void guard(const std::function<void()>& act);
    /// What guard() asks where a material has unsaved changes.
    void askAboutMaterial(const std::function<void()>& act);
    void ask(const std::string& title, const std::string& text,
             std::vector<Question::Answer> answers) {
        mQuestion.ask(title, text, std::move(answers));
    }

    /// What was opened goes to the recent files.
    void remember(const OpenRequest& opened);
    void savePreferences();

    void finishSaving() { mSave.wait(); }
    [[nodiscard]] const BackgroundSave& saving() const { return mSave; }
    /// Takes note of saves that are done. @return whether something changed
    bool poll() { return mSave.poll(); }

    [[nodiscard]] bool isAsking() const { return mFiles.isOpen() || mQuestion.isOpen(); }
    /// Why the file dialog asks once more; empty: it does not.
    [[nodiscard]] const std::string& problem() const { return mFiles.problem(); }
    void draw(float scale);

private:
    /// @param proposed a name, or a file: then its folder is where the dialog begins
    void choose(FileDialog::Kind kind, const std::string& title, std::vector<std::string> suffixes,
                const std::filesystem::path& proposed,
                std::function<void(const std::filesystem::path&)> done);
    /// @param then once it is written
    void saveTo(const MaterialSave& save, const std::function<void()>& then);
    void saveAs(int material, const std::function<void()>& then);
    /// All that are modified from this one on, one after the other.
    void saveFrom(int material, const std::function<void()>& then);
    void replaceDeformers(const std::filesystem::path& file);
    /// To save, to act all the same, or neither.
    void askToSave(const std::string& text, Question::Answer saving,
                   const std::function<void()>& act);
    void guardMaterial(const std::function<void()>& act);
    void guardDeformers(const std::function<void()>& act);
    void guardLights(const std::function<void()>& act);

    Session& mSession;
    BackgroundOpen& mOpen;
    Preferences& mPreferences;
    bool mIsUnattended;
    BackgroundSave mSave;
    FileDialog mFiles;
    Question mQuestion;
    std::filesystem::path mOpenedFrom; ///< the folders that dialogs were left in last
    std::filesystem::path mSavedTo;
};

} // namespace celadon::ui
