#pragma once

#include "app/cli.h"
#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <fcntl.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

/// Runs the program as a user would, or its command line within the test. Link celadon::app.
namespace celadon::test {

struct ProgramResult {
    int exitCode = -1; ///< -1: ended by a signal
    std::string out;
    std::string err;

    /// Lines on stderr.
    [[nodiscard]] long errorLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

/// @param outFile where stdout goes instead of into the result
inline ProgramResult runProgram(std::vector<std::string> arguments,
                                const std::string& outFile = {}) {
    const TemporaryFolder folder;
    const std::string out = outFile.empty() ? (folder / "out").string() : outFile;
    const std::string err = (folder / "err").string();
    arguments.insert(arguments.begin(), CELADON_PROGRAM);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);

    const pid_t child = ::fork();
    if (child == 0) {
        const int outDescriptor = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int errDescriptor = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(outDescriptor, STDOUT_FILENO);
        ::dup2(errDescriptor, STDERR_FILENO);
        ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ProgramResult result;
    result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out = outFile.empty() ? readText(out) : "";
    result.err = readText(err);
    return result;
}

/// The same without a process of its own, which takes a good part of a second to load.
inline ProgramResult runInProcess(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "celadon");
    std::vector<const char*> pointers;
    for (const std::string& argument : arguments) {
        pointers.push_back(argument.c_str());
    }
    ProgramResult result;
    std::string message;
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    try {
        result.exitCode = app::runCommandLine(static_cast<int>(pointers.size()), pointers.data());
    } catch (const Error& error) {
        result.exitCode = static_cast<int>(error.exitCode());
        message = std::string(error.what()) + "\n";
    }
    result.out = ::testing::internal::GetCapturedStdout();
    result.err = ::testing::internal::GetCapturedStderr() + message;
    return result;
}

} // namespace celadon::test
