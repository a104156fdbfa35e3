#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Outputs that would take the place of another file of the same command.
namespace celadon::app {

/// A file with what messages call it: "--stats", "the model".
struct NamedFile {
    std::string name;
    std::filesystem::path file;
};

/// Before the work. Files are compared, not names: links and "./" make no difference.
/// @throws UsageError: two outputs are one file, or an output is one of the inputs
void refuseOverwriting(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

} // namespace celadon::app
