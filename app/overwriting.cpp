#include "app/overwriting.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <system_error>

namespace celadon::app {
namespace {

namespace fs = std::filesystem;

/// Hard links count, and so do files that do not exist yet.
bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) {
        return true;
    }
    const auto canonical = [&](const fs::path& file) { // empty where it cannot be told
        return fs::weakly_canonical(fs::absolute(file, error), error);
    };
    const fs::path resolved = canonical(a);
    return !resolved.empty() && resolved == canonical(b);
}

void refuseSame(const NamedFile& output, const NamedFile& other) {
    if (isSameFile(output.file, other.file)) {
        throw UsageError(fmt::format("{} '{}'", output.name, output.file.string()),
                         fmt::format("is the same file as {}", other.name), "choose another name");
    }
}

} // namespace

void refuseOverwriting(const std::vector<NamedFile>& outputs,
                       const std::vector<NamedFile>& inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t earlier = 0; earlier < i; ++earlier) {
            refuseSame(outputs[i], outputs[earlier]);
        }
        for (const NamedFile& input : inputs) {
            refuseSame(outputs[i], input);
        }
    }
}

} // namespace celadon::app
