// A small program for a machine that has a GPU driver and nothing else (app/core/README.md).
#include "app/argument.h"
#include "app/core/core_bench.h"
#include "renderer/scene/builtin.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/recipes/recipes.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace celadon::core {
namespace {

constexpr int kMaxSide = 16384;

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) {
        parts.push_back(part);
    }
    return parts;
}

std::string join(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

void printHelp() {
    std::vector<std::string> recipes;
    for (const subedit::Recipe& recipe : subedit::recipes()) {
        recipes.emplace_back(recipe.name);
    }
    fmt::print("celadon-core bench: speed and agreement of the backends on this driver, as JSON\n\n"
               "  --model NAME,...      builtins: {}; default vase,sphere\n"
               "  --material NAME,...   recipes: {}; default marble,marble_chessboard\n"
               "  --size WxH,...        of the frame; default 800x600\n"
               "  --irradiance-size N   texels on a side of a light view, whatever the quality\n"
               "  --repeats N           frames that are timed; the median counts; default 5\n"
               "  --truth               errors against the exact sum, which takes a while\n"
               "  --context KIND        auto, egl or osmesa; default auto\n"
               "  --pictures DIR        frames as PFM (linear floats) into this folder\n"
               "  -o, --output FILE     JSON into a file, not to stdout\n",
               join(builtinNames()), join(recipes));
}

int run(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "--help" || words[0] == "-h") {
        printHelp();
        return 0;
    }
    if (words[0] != "bench") {
        throw UsageError(words[0], "is no command of this small program",
                         "take 'bench', or --help for its options");
    }
    BenchRequest request;
    gl::ContextKind kind = gl::ContextKind::Auto;
    std::optional<std::filesystem::path> output;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& option = words[i];
        if (option == "--help" || option == "-h") {
            printHelp();
            return 0;
        }
        if (option == "--truth") {
            request.truth = true;
            continue;
        }
        const app::Argument argument{option, i + 1 < words.size() ? words[i + 1] : ""};
        ++i;
        if (option == "--model") {
            request.models = splitAtCommas(app::parseText(argument));
        } else if (option == "--material") {
            request.materials = splitAtCommas(app::parseText(argument));
        } else if (option == "--size") {
            request.sizes.clear();
            for (const std::string& size : splitAtCommas(app::parseText(argument))) {
                request.sizes.push_back(
                    app::parseSize({option, size}, kMaxSide, 1LL * kMaxSide * kMaxSide));
            }
        } else if (option == "--irradiance-size") {
            request.irradianceSize = app::parseInteger(argument, 8, kMaxSide);
        } else if (option == "--repeats") {
            request.repeats = app::parseInteger(argument, 1, 1000);
        } else if (option == "--context") {
            kind = gl::parseContextKind(argument.text);
        } else if (option == "--pictures") {
            request.pictures = app::parsePath(argument);
        } else if (option == "-o" || option == "--output") {
            output = app::parsePath(argument);
        } else {
            throw UsageError(option, "is no option of 'bench'", "see celadon-core --help");
        }
    }
    if (output) {
        checkWritable(*output);
    }
    const std::unique_ptr<gl::Context> context = gl::createContext(kind);
    const std::string json = runBench(*context, request);
    if (output) {
        writeFileAtomically(*output, std::string_view(json));
    } else {
        std::fputs(json.c_str(), stdout);
    }
    return 0;
}

} // namespace
} // namespace celadon::core

int main(int argc, char** argv) {
    try {
        return celadon::core::run({argv + 1, argv + argc});
    } catch (const celadon::Error& error) {
        std::fprintf(stderr, "celadon-core: %s\n", error.what());
        return static_cast<int>(error.exitCode());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "celadon-core: unexpected failure: %s\n", error.what());
        return 1;
    }
}
