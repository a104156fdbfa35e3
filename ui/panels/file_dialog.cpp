#include "ui/panels/file_dialog.h"

#include "ui/file_names.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

namespace celadon::ui {

namespace {

std::string sizeText(std::uintmax_t bytes) {
    const auto amount = static_cast<double>(bytes);
    return bytes < 1000 * 1000 ? fmt::format("{:.0f} kB", std::ceil(amount / 1e3))
                               : fmt::format("{:.1f} MB", amount / 1e6);
}

} // namespace

void FileDialog::open(Kind kind, const std::string& title, std::vector<std::string> suffixes,
                      const std::filesystem::path& folder, const std::string& name,
                      std::function<void(const std::filesystem::path&)> done) {
    mKind = kind;
    mTitle = title;
    mSuffixes = std::move(suffixes);
    mName = name;
    mDone = std::move(done);
    mWarnedOf.clear();
    mIsOpen = true;
    mAppears = true;
    ++mOpenings;
    mTakesFocus = true;
    std::error_code failed;
    enter(std::filesystem::is_directory(folder, failed) ? folder
                                                        : std::filesystem::current_path(failed));
}

void FileDialog::enter(const std::filesystem::path& folder) {
    std::error_code failed;
    std::vector<Entry> entries;
    for (auto it = std::filesystem::directory_iterator(folder, failed);
         !failed && it != std::filesystem::directory_iterator(); it.increment(failed)) {
        Entry entry;
        entry.name = it->path().filename().string();
        std::error_code ignored;
        entry.isFolder = it->is_directory(ignored);
        if (entry.name.starts_with('.')) {
            continue;
        }
        if (!entry.isFolder && !endsInOne(entry.name, mSuffixes)) {
            continue;
        }
        entry.bytes = entry.isFolder ? 0 : it->file_size(ignored);
        entries.push_back(std::move(entry));
    }
    if (failed) {
        mProblem = fmt::format("{}: {}", folder.string(), failed.message());
        return;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.isFolder != b.isFolder ? a.isFolder : lowered(a.name) < lowered(b.name);
    });
    mProblem.clear();
    mFolder = std::filesystem::weakly_canonical(folder, failed);
    mEntries = std::move(entries);
}

void FileDialog::choose() {
    if (mName.empty()) {
        return;
    }
    std::filesystem::path file = mFolder / mName; // which is mName where that is absolute
    std::error_code failed;
    if (std::filesystem::is_directory(file, failed)) {
        mName.clear();
        enter(file);
        return;
    }
    if (mKind == Kind::Save) {
        const std::optional<std::string> completed = completedName(mName, mSuffixes);
        if (!completed) {
            mProblem =
                fmt::format("Another kind of file: let it end in {}.", fmt::join(mSuffixes, ", "));
            return;
        }
        mName = *completed;
        file = mFolder / mName;
        if (!std::filesystem::is_directory(file.parent_path(), failed)) {
            mProblem = "There is no such folder.";
            return;
        }
        if (std::filesystem::exists(file, failed) && file != mWarnedOf) {
            mWarnedOf = file;
            mProblem = "This file exists. Save again to replace it.";
            return;
        }
    } else if (!std::filesystem::exists(file, failed)) {
        mProblem = "There is no such file.";
        return;
    }
    mIsOpen = false;
    std::exchange(mDone, nullptr)(file); // which may open another
}

void FileDialog::drawPlaces(float scale) {
    const auto place = [&](const char* label, const std::filesystem::path& folder) {
        std::error_code failed;
        if (!folder.empty() && std::filesystem::is_directory(folder, failed)) {
            if (ImGui::Button(label)) {
                enter(folder);
            }
            tooltip(folder.c_str());
            ImGui::SameLine();
        }
    };
    const char* const home = std::getenv("HOME");
    const char* const models = std::getenv("CELADON_MODELS");
    std::error_code failed;
    place("Up", mFolder.parent_path());
    place("Home", home != nullptr ? home : "");
    place("Here", std::filesystem::current_path(failed));
    place("Models", models != nullptr ? models : "");
    ImGui::NewLine();
    static_cast<void>(scale);
    ImGui::TextDisabled("%s", mFolder.c_str());
}

void FileDialog::drawEntries(float height) {
    if (!ImGui::BeginChild("##entries", {0.0f, height}, true)) {
        ImGui::EndChild();
        return;
    }
    std::filesystem::path next;
    for (const Entry& entry : mEntries) {
        const std::string label = entry.isFolder ? entry.name + "/" : entry.name;
        if (entry.isFolder) {
            ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
        }
        const bool isClicked = ImGui::Selectable(label.c_str(), entry.name == mName,
                                                 ImGuiSelectableFlags_AllowDoubleClick);
        if (entry.isFolder) {
            ImGui::PopStyleColor();
        } else {
            const std::string size = sizeText(entry.bytes);
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x -
                            ImGui::CalcTextSize(size.c_str()).x);
            ImGui::TextDisabled("%s", size.c_str());
        }
        if (isClicked && entry.isFolder) {
            next = mFolder / entry.name;
        } else if (isClicked) {
            mName = entry.name;
            if (mKind == Kind::Open && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
                choose();
                break;
            }
        }
    }
    if (!next.empty()) {
        enter(next);
    }
    ImGui::EndChild();
}

void FileDialog::draw(float scale) {
    if (!mIsOpen) {
        return;
    }
    const std::string id = mTitle + "##files";
    if (mAppears) {
        ImGui::OpenPopup(id.c_str());
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(620.0f * scale, 0.96f * display.x), std::min(520.0f * scale, 0.94f * display.y)});
    bool isShown = true;
    if (ImGui::BeginPopupModal(id.c_str(), &isShown,
                               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings)) {
        drawPlaces(scale);
        const float below = 3.4f * ImGui::GetFrameHeightWithSpacing();
        drawEntries(std::max(60.0f, ImGui::GetContentRegionAvail().y - below));
        const bool isNew = std::exchange(mAppears, false);
        if (std::exchange(mTakesFocus, false)) {
            ImGui::SetKeyboardFocusHere();
        }
        ImGui::SetNextItemWidth(-1.0f);
        // Dear ImGui keeps what was typed, and what was selected, by the field's ID: each opening
        // has its own, so that the proposed name is there, and is what typing replaces.
        ImGui::PushID(mOpenings);
        ImGui::InputTextWithHint("##name", "File name or path", &mName);
        ImGui::PopID();
        const auto isPressed = [](ImGuiKey key) {
            return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
        };
        const bool isEntered =
            !isNew && (isPressed(ImGuiKey_Enter) || isPressed(ImGuiKey_KeyPadEnter));
        if (mProblem.empty()) {
            ImGui::NewLine();
        } else {
            ImGui::TextColored(palette().warning, "%s", mProblem.c_str());
        }
        const float width = 110.0f * scale;
        ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2.0f * width -
                             ImGui::GetStyle().ItemSpacing.x);
        const bool isCancelled =
            ImGui::Button("Cancel", {width, 0.0f}) || isPressed(ImGuiKey_Escape);
        ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Button, palette().accentDim);
        const bool isAccepted = ImGui::Button(mKind == Kind::Save ? "Save" : "Open", {width, 0.0f});
        ImGui::PopStyleColor();
        if (isEntered || isAccepted) {
            choose();
            mTakesFocus = true; // where it asks once more, the name can be typed at once
        } else if (isCancelled) {
            mIsOpen = false;
        }
        if (!mIsOpen || !isShown) {
            mIsOpen = false;
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    } else {
        mIsOpen = false;
    }
}

} // namespace celadon::ui
