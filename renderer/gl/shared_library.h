#pragma once

#include <dlfcn.h>
#include <string>

namespace celadon::gl {

/// A library that may be missing on the machine. It is never closed again: drivers leave thread
/// local destructors and atexit handlers behind that would jump into unmapped code.
class SharedLibrary {
public:
    /// RTLD_LOCAL: OSMesa exports over a thousand gl* names that must not shadow the real ones.
    explicit SharedLibrary(const char* name) : mHandle(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
        if (mHandle == nullptr) {
            const char* reason = dlerror();
            mReason = reason != nullptr ? reason : "cannot be opened";
        }
    }

    /// Fetches a function; the first that is missing becomes the reason.
    template<class Function>
    void load(Function*& function, const char* name) {
        if (mHandle == nullptr) {
            return;
        }
        function = reinterpret_cast<Function*>(dlsym(mHandle, name));
        if (function == nullptr && mReason.empty()) {
            mReason = std::string("has no ") + name;
        }
    }

    /// Why it cannot be used; empty when it can.
    [[nodiscard]] const std::string& reason() const { return mReason; }

private:
    void* mHandle;
    std::string mReason;
};

} // namespace celadon::gl
