#pragma once

#include "renderer/gl/context.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What a machine with a GPU and nothing else is asked: how fast is each backend there, do they
/// agree, and what does it look like. Builtin models, recipes as materials, no file that is read.
namespace celadon::core {

struct BenchRequest {
    std::vector<std::string> models{"vase", "sphere"};
    std::vector<std::string> materials{"marble", "marble_chessboard"}; ///< recipes
    std::vector<glm::ivec2> sizes{{800, 600}};
    std::optional<int> irradianceSize; ///< N of the light views; else as each quality has it
    int repeats = 5;
    bool truth = false; ///< errors against image-reference, on the CPU, at 160 x 120
    std::optional<std::filesystem::path> pictures; ///< a folder for PFM files
};

/// One JSON object, indented.
/// @throws UsageError for an unknown model or material; ContextError, ShaderError, OutputError
[[nodiscard]] std::string runBench(const gl::Context& context, const BenchRequest& request);

} // namespace celadon::core
