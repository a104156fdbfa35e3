#pragma once

#include <stdexcept>
#include <string>

/// Failures of the world (file, device, memory), as opposed to programmer mistakes (assert.h).
/// Each carries what, where and why, and what the user can do; `app/main` prints one line and
/// exits with `exitCode()` (DESIGN section 5).
namespace celadon {

enum class ExitCode { Done = 0, Failed = 1, Usage = 2, Input = 3, NoContext = 4 };

class Error : public std::runtime_error {
public:
    /// @param subject what failed, with the whole path in single quotes: "'a/b.obj', line 12"
    /// @param reason  why: "vertex index 9 is past the 8 vertices before it"
    /// @param remedy  what to do: "export the mesh again"; may be empty
    Error(const std::string& subject, const std::string& reason, const std::string& remedy,
          ExitCode code)
        : std::runtime_error(subject + ": " + reason + (remedy.empty() ? "" : "; " + remedy)),
          mCode(code) {}

    [[nodiscard]] ExitCode exitCode() const noexcept { return mCode; }

private:
    ExitCode mCode;
};

/// An input cannot be read or is invalid.
struct InputError : Error {
    InputError(const std::string& subject, const std::string& reason,
               const std::string& remedy = {})
        : Error(subject, reason, remedy, ExitCode::Input) {}
};

/// The command line asks for something that does not exist or does not fit together.
struct UsageError : Error {
    UsageError(const std::string& subject, const std::string& reason,
               const std::string& remedy = {})
        : Error(subject, reason, remedy, ExitCode::Usage) {}
};

/// An output cannot be written; whatever was there before is untouched.
struct OutputError : Error {
    OutputError(const std::string& subject, const std::string& reason,
                const std::string& remedy = {})
        : Error(subject, reason, remedy, ExitCode::Failed) {}
};

/// No usable OpenGL context, or the driver lacks what is needed.
struct ContextError : Error {
    ContextError(const std::string& subject, const std::string& reason,
                 const std::string& remedy = {})
        : Error(subject, reason, remedy, ExitCode::NoContext) {}
};

/// A shader does not compile or link; the message holds file:line of the source.
struct ShaderError : Error {
    ShaderError(const std::string& subject, const std::string& reason,
                const std::string& remedy = {})
        : Error(subject, reason, remedy, ExitCode::Failed) {}
};

} // namespace celadon
