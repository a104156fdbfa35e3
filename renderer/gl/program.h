#pragma once

#include "renderer/gl/handle.h"
#include "renderer/gl/shader_source.h"

#include <glad/gl.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// A linked program. Uniforms are set by their `layout(location = …)`, never by name; the type must
/// be that of the declaration. A location that the compiler found unused is ignored.
class Program {
public:
    /// Empty; id() is 0.
    Program() = default;
    /// @throws ShaderError with file:line of the first errors
    Program(std::string_view label, std::span<const ShaderSource> stages);
    /// From paths relative to shaders/. WIDE_GROUPS is defined where the driver is software
    /// (include/group_sizes.glsl).
    Program(std::string_view label, const ShaderLibrary& library,
            const std::vector<std::string_view>& paths,
            const std::vector<ShaderDefine>& defines = {});

    /// For a shader that is being edited: nothing is thrown, and the caller keeps its last good
    /// program when null comes back.
    /// @param diagnostics receives what the driver said, warnings too
    [[nodiscard]] static std::optional<Program> build(std::string_view label,
                                                      std::span<const ShaderSource> stages,
                                                      std::vector<ShaderDiagnostic>& diagnostics);

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    explicit operator bool() const { return static_cast<bool>(mHandle); }
    void use() const { glUseProgram(id()); }

    /// Of a compute shader, which must be in use: an invocation for each texel of as many pictures
    /// as there are layers, or for each `each` elements of a list. Groups may reach beyond.
    void dispatchOver(glm::ivec2 size, int layers = 1) const;
    void dispatchList(int count, int each = 1) const;
    /// So many work groups in a row. @param size that a group must have
    void dispatchGroups(int count, glm::ivec2 size) const;

    void set(GLint location, float value) const { glProgramUniform1f(id(), location, value); }
    void set(GLint location, int value) const { glProgramUniform1i(id(), location, value); }
    void set(GLint location, unsigned value) const { glProgramUniform1ui(id(), location, value); }
    void set(GLint location, bool value) const { set(location, value ? 1 : 0); }
    void set(GLint location, glm::vec2 value) const {
        glProgramUniform2fv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::vec3 value) const {
        glProgramUniform3fv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::vec4 value) const {
        glProgramUniform4fv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::ivec2 value) const {
        glProgramUniform2iv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::ivec3 value) const {
        glProgramUniform3iv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::ivec4 value) const {
        glProgramUniform4iv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::uvec2 value) const {
        glProgramUniform2uiv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::uvec3 value) const {
        glProgramUniform3uiv(id(), location, 1, &value.x);
    }
    void set(GLint location, glm::uvec4 value) const {
        glProgramUniform4uiv(id(), location, 1, &value.x);
    }
    void set(GLint location, const glm::mat3& value) const {
        glProgramUniformMatrix3fv(id(), location, 1, GL_FALSE, &value[0].x);
    }
    void set(GLint location, const glm::mat4& value) const {
        glProgramUniformMatrix4fv(id(), location, 1, GL_FALSE, &value[0].x);
    }
    void set(GLint location, std::span<const float> values) const {
        glProgramUniform1fv(id(), location, static_cast<GLsizei>(values.size()), values.data());
    }
    void set(GLint location, std::span<const int> values) const {
        glProgramUniform1iv(id(), location, static_cast<GLsizei>(values.size()), values.data());
    }
    void set(GLint location, std::span<const glm::vec2> values) const {
        glProgramUniform2fv(id(), location, static_cast<GLsizei>(values.size()),
                            values.empty() ? nullptr : &values[0].x);
    }
    void set(GLint location, std::span<const glm::vec4> values) const {
        glProgramUniform4fv(id(), location, static_cast<GLsizei>(values.size()),
                            values.empty() ? nullptr : &values[0].x);
    }

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteProgram(id); }
    };

    Handle<Traits> mHandle;
    glm::ivec3 mGroup{0}; ///< invocations of a work group of a compute shader
};

} // namespace celadon::gl
