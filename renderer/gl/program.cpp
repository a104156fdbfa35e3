#include "renderer/gl/program.h"

#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace celadon::gl {

namespace {

struct ShaderTraits {
    static void destroy(GLuint id) { glDeleteShader(id); }
};
using Shader = Handle<ShaderTraits>;

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
    GLsizei written = 0;
    glGetShaderInfoLog(shader, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
    GLsizei written = 0;
    glGetProgramInfoLog(program, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

void append(std::vector<ShaderDiagnostic>& all, std::vector<ShaderDiagnostic> more) {
    all.insert(all.end(), more.begin(), more.end());
}

Shader compile(const ShaderSource& source, std::vector<ShaderDiagnostic>& diagnostics, bool& good) {
    Shader shader(glCreateShader(source.stage()));
    labelObject(GL_SHADER, shader.id(), source.path());
    const char* const text = source.text().c_str();
    const auto length = static_cast<GLint>(source.text().size());
    glShaderSource(shader.id(), 1, &text, &length);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    append(diagnostics, source.translateLog(shaderLog(shader.id())));
    if (compiled == GL_FALSE) {
        good = false;
        if (diagnostics.empty()) {
            diagnostics.push_back({source.path(), 0, "does not compile; the driver says no more"});
        }
    }
    return shader;
}

/// One line with the first errors; drivers repeat themselves after those.
std::string summary(const std::vector<ShaderDiagnostic>& diagnostics) {
    constexpr std::size_t kShown = 3;
    std::string text;
    std::size_t shown = 0;
    for (const bool errors : {true, false}) {
        for (const ShaderDiagnostic& diagnostic : diagnostics) {
            const bool isError = diagnostic.message.find("rror") != std::string::npos;
            if (isError == errors && shown < kShown) {
                text += (shown++ > 0 ? "; " : "") + diagnostic.text();
            }
        }
        if (shown > 0) {
            break; // warnings only where there is nothing else
        }
    }
    return text;
}

std::vector<ShaderSource> loadStages(const ShaderLibrary& library,
                                     const std::vector<std::string_view>& paths,
                                     const std::vector<ShaderDefine>& defines) {
    std::vector<ShaderSource> stages;
    std::vector<ShaderDefine> all = defines;
    if (const Context* context = Context::current(); context != nullptr && context->isSoftware()) {
        all.push_back({"WIDE_GROUPS", "1"});
    }
    for (const std::string_view path : paths) {
        stages.push_back(ShaderSource::load(library, path, all));
    }
    return stages;
}

} // namespace

std::optional<Program> Program::build(std::string_view label, std::span<const ShaderSource> stages,
                                      std::vector<ShaderDiagnostic>& diagnostics) {
    bool good = true;
    std::vector<Shader> shaders;
    for (const ShaderSource& stage : stages) {
        shaders.push_back(compile(stage, diagnostics, good));
    }
    if (!good) {
        return std::nullopt;
    }
    Program program;
    program.mHandle = Handle<Traits>(glCreateProgram());
    labelObject(GL_PROGRAM, program.id(), label);
    for (const Shader& shader : shaders) {
        glAttachShader(program.id(), shader.id());
    }
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    for (const Shader& shader : shaders) {
        glDetachShader(program.id(), shader.id()); // so that deleting frees them
    }
    const std::string log = programLog(program.id());
    if (!stages.empty()) {
        append(diagnostics, stages.front().translateLog(log));
    }
    if (linked == GL_FALSE) {
        if (diagnostics.empty()) {
            diagnostics.push_back({"", 0, "does not link; the driver says no more"});
        }
        return std::nullopt;
    }
    if (stages.size() == 1 && stages.front().stage() == GL_COMPUTE_SHADER) {
        glGetProgramiv(program.id(), GL_COMPUTE_WORK_GROUP_SIZE, &program.mGroup.x);
    }
    return program;
}

void Program::dispatchOver(glm::ivec2 size, int layers) const {
    const glm::ivec3 groups = (glm::ivec3(size, layers) + mGroup - 1) / mGroup;
    if (groups.x > 0 && groups.y > 0 && groups.z > 0) {
        glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                          static_cast<GLuint>(groups.z));
    }
}

void Program::dispatchList(int count, int each) const {
    constexpr int kMostAcross = 512; // the rest goes to y
    const int groups = (count + mGroup.x * each - 1) / (mGroup.x * each);
    const int across = std::min(groups, kMostAcross);
    if (groups > 0) {
        glDispatchCompute(static_cast<GLuint>(across),
                          static_cast<GLuint>((groups + across - 1) / across), 1);
    }
}

void Program::dispatchGroups(int count, [[maybe_unused]] glm::ivec2 size) const {
    CELADON_ASSERT(glm::ivec2(mGroup) == size);
    glDispatchCompute(static_cast<GLuint>(count), 1, 1);
}

Program::Program(std::string_view label, std::span<const ShaderSource> stages) {
    std::vector<ShaderDiagnostic> diagnostics;
    std::optional<Program> program = build(label, stages, diagnostics);
    if (!program) {
        throw ShaderError(fmt::format("shader program '{}'", label), summary(diagnostics));
    }
    *this = std::move(*program);
}

Program::Program(std::string_view label, const ShaderLibrary& library,
                 const std::vector<std::string_view>& paths,
                 const std::vector<ShaderDefine>& defines)
    : Program(label, loadStages(library, paths, defines)) {}

} // namespace celadon::gl
