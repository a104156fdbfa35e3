#pragma once

#include "ui/session.h"

#include <filesystem>
#include <vector>

/// `--watch`: says when the files of what is open change on disk.
namespace celadon::ui {

class FileWatch {
public:
    /// Looks at the times of the files. @return whether they differ from the last look, at the same
    ///         model and material
    bool hasChanged(const OpenRequest& opened) {
        std::vector<std::filesystem::file_time_type> times;
        for (const std::string& name : {opened.model, opened.material}) {
            std::error_code failed;
            const auto time = std::filesystem::last_write_time(name, failed);
            times.push_back(failed ? std::filesystem::file_time_type::min() : time);
        }
        const bool isSame = opened.model == mOpened.model && opened.material == mOpened.material;
        const bool result = isSame && times != mTimes;
        mOpened = opened;
        mTimes = std::move(times);
        return result;
    }

private:
    OpenRequest mOpened; ///< files whose times these are
    std::vector<std::filesystem::file_time_type> mTimes;
};

} // namespace celadon::ui
