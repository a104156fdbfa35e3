#pragma once

#include "renderer/gl/shader_library.h"

#include <string>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// One line of a driver's log, or of the include resolver, mapped back to the file it is about.
struct ShaderDiagnostic {
    std::string file; ///< relative to shaders/; empty when the driver named none
    int line = 0;     ///< from 1; 0 when the driver named none
    std::string message;

    /// "include/profile.glsl:41: undefined variable"
    [[nodiscard]] std::string text() const;
};

/// The whole text of one shader stage, ready for the driver. Three things are done, and no other
/// language is put on top of GLSL:
/// - `#include "x.glsl"` is resolved, relative to the including file, to shaders/ or to
///   shaders/include/;
///   a file is included once per shader, as if each had a guard; cycles are errors. An #include
///   within #if is refused: files are included whatever the options say.
/// - `#version 450 core` and the defines come first; `#line` numbers lines and files.
/// - the driver's log is mapped back to files and lines.
/// The line number holds the file as well: line 41 of file 2 is `#line 200041 2`. Mesa forgets the
/// file for errors within expressions and says 0 (22.3: the parser's default location has none).
class ShaderSource {
public:
    /// @param path relative to shaders/; its extension (.vert .tesc .tese .geom .frag .comp) names
    ///             the stage
    /// @throws ShaderError with file:line
    [[nodiscard]] static ShaderSource load(const ShaderLibrary& library, std::string_view path,
                                           std::vector<ShaderDefine> defines = {});

    [[nodiscard]] const std::string& path() const { return mFiles[kFirstFile]; }
    [[nodiscard]] unsigned stage() const { return mStage; } ///< GL_VERTEX_SHADER, …
    [[nodiscard]] const std::string& text() const { return mText; }
    /// Everything that was read: the shader itself, then its includes, in order of appearance.
    [[nodiscard]] std::vector<std::string> files() const {
        return {mFiles.begin() + kFirstFile, mFiles.end()};
    }

    /// Understands Mesa "2:200041(3): error: …", NVIDIA "2(200041) : error …", others
    /// "ERROR: 2:200041: …"; with plain line numbers as well.
    /// Lines in other forms are kept without file and line.
    [[nodiscard]] std::vector<ShaderDiagnostic> translateLog(std::string_view log) const;

private:
    class Resolver;
    static constexpr int kFirstFile = 1;
    static constexpr int kLinesPerFile = 100000;

    unsigned mStage = 0;
    std::string mText;
    /// By the source string number of #line; number 0 is the head with version and defines.
    std::vector<std::string> mFiles{"options"};
};

} // namespace celadon::gl
