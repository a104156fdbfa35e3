#include "app/cli.h"
#include "subedit/errors.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace {

/// One line on stderr, whatever the message holds.
int fail(std::string message, celadon::ExitCode code) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fprintf(stderr, "celadon: %s\n", message.c_str());
    return static_cast<int>(code);
}

} // namespace

int main(int argc, char** argv) {
    using celadon::ExitCode;
    try {
        const int code = celadon::app::runCommandLine(argc, argv);
        // Results that did not arrive (a full disk, a closed pipe) are not done.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            return fail("standard output: cannot be written", ExitCode::Failed);
        }
        return code;
    } catch (const celadon::Error& error) {
        std::fflush(stdout);
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("memory: not enough for this; make the picture or the model smaller",
                    ExitCode::Failed);
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) { // fmt::print throws
            return fail("standard output: cannot be written", ExitCode::Failed);
        }
        return fail(std::string("unexpected failure: ") + error.what(), ExitCode::Failed);
    }
}
