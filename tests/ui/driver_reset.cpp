// Preloaded into the editor by window_test.sh: a graphics driver that is reset as soon as the file
// that CELADON_DRIVER_RESET names is there.
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <unistd.h>

namespace {

using Function = void (*)();
using GetProcAddress = Function (*)(const char*);

unsigned resetStatus() {
    constexpr unsigned kNoError = 0;
    constexpr unsigned kUnknownContextReset = 0x8255;
    const char* const file = std::getenv("CELADON_DRIVER_RESET");
    return file != nullptr && ::access(file, F_OK) == 0 ? kUnknownContextReset : kNoError;
}

} // namespace

extern "C" Function glfwGetProcAddress(const char* name) {
    static const auto real =
        reinterpret_cast<GetProcAddress>(::dlsym(RTLD_NEXT, "glfwGetProcAddress"));
    return std::strcmp(name, "glGetGraphicsResetStatus") == 0
               ? reinterpret_cast<Function>(&resetStatus)
               : real(name);
}
