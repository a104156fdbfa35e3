#include "renderer/gl/shader_source.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <utility>

namespace celadon::gl {

namespace {

std::string_view trim(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

unsigned stageOf(std::string_view path) {
    constexpr std::array<std::pair<std::string_view, unsigned>, 6> kStages{{
        {".vert", GL_VERTEX_SHADER},
        {".tesc", GL_TESS_CONTROL_SHADER},
        {".tese", GL_TESS_EVALUATION_SHADER},
        {".geom", GL_GEOMETRY_SHADER},
        {".frag", GL_FRAGMENT_SHADER},
        {".comp", GL_COMPUTE_SHADER},
    }};
    for (const auto& [extension, stage] : kStages) {
        if (path.ends_with(extension)) {
            return stage;
        }
    }
    throw ShaderError(fmt::format("shader '{}'", path), "its extension names no stage",
                      "use .vert, .tesc, .tese, .geom, .frag or .comp");
}

/// The line without comments. @param inComment whether it starts, and then ends, in /* … */
std::string withoutComments(std::string_view line, bool& inComment) {
    std::string code;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string_view pair = line.substr(i, 2);
        if (inComment) {
            if (pair == "*/") {
                inComment = false;
                code += ' ';
                ++i;
            }
        } else if (pair == "/*") {
            inComment = true;
            ++i;
        } else if (pair == "//") {
            break;
        } else {
            code += line[i];
        }
    }
    return code;
}

struct Directive {
    std::string_view name;     ///< "include", "if", …
    std::string_view argument; ///< trimmed
};

std::optional<Directive> parseDirective(std::string_view code) {
    code = trim(code);
    if (!code.starts_with('#')) {
        return std::nullopt;
    }
    code = trim(code.substr(1));
    const std::size_t end = std::min(code.find_first_of(" \t\"<("), code.size());
    return Directive{code.substr(0, end), trim(code.substr(end))};
}

} // namespace

std::string ShaderDiagnostic::text() const {
    return file.empty() ? message : fmt::format("{}:{}: {}", file, line, message);
}

/// Reads a file and, where they stand, its includes.
class ShaderSource::Resolver {
public:
    Resolver(const ShaderLibrary& library, ShaderSource& source)
        : mLibrary(library), mSource(source) {}

    void appendRoot(std::string_view path) {
        std::optional<std::string> text = mLibrary.text(path);
        if (!text) {
            throw ShaderError(fmt::format("shader '{}'", path),
                              fmt::format("not among {}", mLibrary.description()));
        }
        append(std::string(path), *text);
    }

private:
    void append(const std::string& path, std::string_view text) {
        const std::size_t number = mSource.mFiles.size();
        mSource.mFiles.push_back(path);
        mOpen.push_back(path);
        appendLineDirective(1, number);
        bool inComment = false;
        int conditionDepth = 0;
        int line = 0;
        while (!text.empty()) {
            ++line;
            const std::size_t end = std::min(text.find('\n'), text.size());
            const std::string_view raw = text.substr(0, end);
            text.remove_prefix(std::min(end + 1, text.size()));
            const bool startsInComment = inComment;
            const std::string code = withoutComments(raw, inComment);
            const auto directive = startsInComment ? std::nullopt : parseDirective(code);
            if (directive && directive->name == "include") {
                if (conditionDepth > 0) {
                    fail(path, line, "#include within #if; files are included whatever it says");
                }
                include(path, line, directive->argument);
                appendLineDirective(line + 1, number);
                continue;
            }
            if (directive && directive->name == "version") {
                fail(path, line, "the loader adds #version 450 core itself; remove this line");
            }
            if (directive && directive->name.starts_with("if")) {
                ++conditionDepth;
            } else if (directive && directive->name == "endif") {
                --conditionDepth;
            }
            mSource.mText.append(raw).append("\n");
        }
        if (inComment) {
            fail(path, line, "a comment /* is not closed");
        }
        mOpen.pop_back();
    }

    void appendLineDirective(int line, std::size_t number) {
        mSource.mText += fmt::format("#line {} {}\n",
                                     number * static_cast<std::size_t>(kLinesPerFile) +
                                         static_cast<std::size_t>(line),
                                     number);
    }

    void include(const std::string& from, int line, std::string_view argument) {
        if (argument.size() < 3 || argument.front() != '"' || argument.back() != '"') {
            fail(from, line, "#include wants a name in double quotes");
        }
        const std::string_view name = argument.substr(1, argument.size() - 2);
        const std::size_t slash = from.rfind('/');
        const std::string folder = slash != std::string::npos ? from.substr(0, slash + 1) : "";
        const std::string beside = folder + std::string(name);
        const std::string shared = "include/" + std::string(name);
        for (const std::string& path : {beside, std::string(name), shared}) {
            if (std::find(mOpen.begin(), mOpen.end(), path) != mOpen.end()) {
                fail(from, line,
                     fmt::format("include cycle: {} -> {}", fmt::join(mOpen, " -> "), path));
            }
            const auto firstFile = mSource.mFiles.begin() + kFirstFile;
            if (std::find(firstFile, mSource.mFiles.end(), path) != mSource.mFiles.end()) {
                return;
            }
            if (const std::optional<std::string> text = mLibrary.text(path)) {
                append(path, *text);
                return;
            }
        }
        fail(from, line,
             fmt::format("cannot find \"{}\" in {}, as '{}', '{}' or '{}'", name,
                         mLibrary.description(), beside, name, shared));
    }

    [[noreturn]] static void fail(const std::string& path, int line, const std::string& reason) {
        throw ShaderError(fmt::format("shader {}:{}", path, line), reason);
    }

    const ShaderLibrary& mLibrary;
    ShaderSource& mSource;
    std::vector<std::string> mOpen; ///< from the shader to the file being read
};

ShaderSource ShaderSource::load(const ShaderLibrary& library, std::string_view path,
                                std::vector<ShaderDefine> defines) {
    ShaderSource source;
    source.mStage = stageOf(path);
    source.mText = "#version 450 core\n";
    defines.insert(defines.end(), library.defines().begin(), library.defines().end());
    for (const ShaderDefine& define : defines) {
        source.mText += fmt::format("#define {} {}\n", define.name, define.value);
    }
    Resolver(library, source).appendRoot(path);
    return source;
}

std::vector<ShaderDiagnostic> ShaderSource::translateLog(std::string_view log) const {
    // 1: a word before; 2: source number; 3 or 4: line; 5: the rest
    static const std::regex pattern(
        R"(^\s*(?:(ERROR|WARNING):\s*)?(\d{1,6})(?::(\d{1,9})(?:\(\d+\))?|\((\d{1,9})\))\s*:\s*(.*)$)");
    std::vector<ShaderDiagnostic> diagnostics;
    while (!log.empty()) {
        const std::size_t end = std::min(log.find('\n'), log.size());
        const std::string line(trim(log.substr(0, end)));
        log.remove_prefix(std::min(end + 1, log.size()));
        // Drivers may put a terminating zero into the log's length.
        if (line.empty() || line.front() == '\0') {
            continue;
        }
        std::smatch match;
        if (!std::regex_match(line, match, pattern)) {
            diagnostics.push_back({"", 0, line});
            continue;
        }
        const int number = std::stoi(match[3].matched ? match[3] : match[4]);
        const int file = number >= kLinesPerFile ? number / kLinesPerFile : std::stoi(match[2]);
        if (static_cast<std::size_t>(file) >= mFiles.size()) {
            diagnostics.push_back({"", 0, line});
            continue;
        }
        const std::string severity = match[1].matched ? match[1].str() + ": " : "";
        diagnostics.push_back({mFiles[static_cast<std::size_t>(file)], number % kLinesPerFile,
                               severity + match[5].str()});
    }
    return diagnostics;
}

} // namespace celadon::gl
