#include "renderer/gl/backends.h"
#include "renderer/gl/shared_library.h"
#include "subedit/errors.h"

// The library is opened at run time: a machine without EGL can still use OSMesa.
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <utility>

namespace celadon::gl {

namespace {

struct EglApi {
    SharedLibrary library{"libEGL.so.1"};
    PFNEGLGETPROCADDRESSPROC getProcAddress = nullptr;
    PFNEGLQUERYSTRINGPROC queryString = nullptr;
    PFNEGLGETERRORPROC getError = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLTERMINATEPROC terminate = nullptr;
    PFNEGLBINDAPIPROC bindApi = nullptr;
    PFNEGLCHOOSECONFIGPROC chooseConfig = nullptr;
    PFNEGLCREATECONTEXTPROC createContext = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroyContext = nullptr;
    PFNEGLCREATEPBUFFERSURFACEPROC createPbufferSurface = nullptr;
    PFNEGLDESTROYSURFACEPROC destroySurface = nullptr;
    PFNEGLMAKECURRENTPROC makeCurrent = nullptr;
    // Extensions of the client; null where it lacks them.
    PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;
    PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
    std::string extensions; ///< of the client, without a display

    EglApi() {
        library.load(getProcAddress, "eglGetProcAddress");
        library.load(queryString, "eglQueryString");
        library.load(getError, "eglGetError");
        library.load(initialize, "eglInitialize");
        library.load(terminate, "eglTerminate");
        library.load(bindApi, "eglBindAPI");
        library.load(chooseConfig, "eglChooseConfig");
        library.load(createContext, "eglCreateContext");
        library.load(destroyContext, "eglDestroyContext");
        library.load(createPbufferSurface, "eglCreatePbufferSurface");
        library.load(destroySurface, "eglDestroySurface");
        library.load(makeCurrent, "eglMakeCurrent");
        if (!library.reason().empty()) {
            return;
        }
        if (const char* text = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS); text != nullptr) {
            extensions = text;
        }
        loadExtension(getPlatformDisplay, "eglGetPlatformDisplayEXT", "EGL_EXT_platform_base");
        const bool enumerates = has("EGL_EXT_device_base") ||
                                (has("EGL_EXT_device_enumeration") && has("EGL_EXT_device_query"));
        if (enumerates) {
            loadExtension(queryDevices, "eglQueryDevicesEXT", nullptr);
            loadExtension(queryDeviceString, "eglQueryDeviceStringEXT", nullptr);
        }
    }

    [[nodiscard]] bool has(std::string_view extension) const;

private:
    template<class Function>
    void loadExtension(Function& function, const char* name, const char* extension) {
        if (extension == nullptr || has(extension)) {
            function = reinterpret_cast<Function>(getProcAddress(name));
        }
    }
};

bool listHas(std::string_view list, std::string_view word) {
    for (std::size_t at = list.find(word); at != std::string_view::npos;
         at = list.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || list[at - 1] == ' ') && (end == list.size() || list[end] == ' ')) {
            return true;
        }
    }
    return false;
}

bool EglApi::has(std::string_view extension) const {
    return listHas(extensions, extension);
}

const EglApi& eglApi() {
    static const EglApi api;
    return api;
}

std::string eglErrorName(EGLint error) {
    switch (error) {
    case EGL_SUCCESS:
        return "no error given";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
        return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    case EGL_CONTEXT_LOST:
        return "EGL_CONTEXT_LOST";
    default:
        return fmt::format("EGL error {:#x}", error);
    }
}

[[noreturn]] void fail(const std::string& name, const char* what) {
    throw ContextError(name, fmt::format("{}: {}", what, eglErrorName(eglApi().getError())));
}

/// An initialized display. EGL hands out one display per platform and device in the process, and
/// terminating it ends all of its contexts: hence contexts share it.
class SharedDisplay {
public:
    /// @param native null for the surfaceless platform, else the device
    static std::shared_ptr<SharedDisplay> open(const std::string& name, EGLenum platform,
                                               void* native) {
        static std::mutex mutex;
        static std::map<std::pair<EGLenum, void*>, std::weak_ptr<SharedDisplay>> opened;
        const std::lock_guard lock(mutex);
        auto& entry = opened[{platform, native}];
        std::shared_ptr<SharedDisplay> display = entry.lock();
        if (display == nullptr) {
            display = std::make_shared<SharedDisplay>(name, platform, native);
            entry = display;
        }
        return display;
    }

    SharedDisplay(const std::string& name, EGLenum platform, void* native) {
        const EglApi& egl = eglApi();
        mDisplay = egl.getPlatformDisplay(platform, native, nullptr);
        if (mDisplay == EGL_NO_DISPLAY) {
            fail(name, "no display");
        }
        if (!egl.initialize(mDisplay, nullptr, nullptr)) {
            fail(name, "eglInitialize failed");
        }
        const char* text = egl.queryString(mDisplay, EGL_EXTENSIONS);
        mExtensions = text != nullptr ? text : "";
    }
    ~SharedDisplay() { eglApi().terminate(mDisplay); }
    SharedDisplay(const SharedDisplay&) = delete;
    SharedDisplay& operator=(const SharedDisplay&) = delete;

    [[nodiscard]] EGLDisplay get() const { return mDisplay; }
    [[nodiscard]] bool has(std::string_view extension) const {
        return listHas(mExtensions, extension);
    }

private:
    EGLDisplay mDisplay = EGL_NO_DISPLAY;
    std::string mExtensions;
};

class EglContext final : public Context {
public:
    EglContext(const std::string& name, EGLenum platform, void* native)
        : Context(ContextKind::Egl, name), mDisplay(SharedDisplay::open(name, platform, native)) {
        try {
            create();
            initialize(eglApi().getProcAddress);
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~EglContext() override { destroy(); }

private:
    void create() {
        const EglApi& egl = eglApi();
        const bool surfaceless = mDisplay->has("EGL_KHR_surfaceless_context");
        if (!mDisplay->has("EGL_KHR_create_context")) {
            throw ContextError(description(), "the display has no EGL_KHR_create_context");
        }
        if (!egl.bindApi(EGL_OPENGL_API)) {
            fail(description(), "eglBindAPI for OpenGL failed");
        }
        EGLConfig config = nullptr;
        if (!surfaceless || !mDisplay->has("EGL_KHR_no_config_context")) {
            config = chooseConfig();
        }
        constexpr std::array<EGLint, 9> kAttributes{EGL_CONTEXT_MAJOR_VERSION_KHR,
                                                    kGlMajor,
                                                    EGL_CONTEXT_MINOR_VERSION_KHR,
                                                    kGlMinor,
                                                    EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                                    EGL_CONTEXT_FLAGS_KHR,
                                                    EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR,
                                                    EGL_NONE};
        mContext = egl.createContext(mDisplay->get(), config, EGL_NO_CONTEXT, kAttributes.data());
        if (mContext == EGL_NO_CONTEXT) {
            fail(description(), "no OpenGL 4.5 core context");
        }
        if (!surfaceless) {
            constexpr std::array<EGLint, 5> kSize{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
            mSurface = egl.createPbufferSurface(mDisplay->get(), config, kSize.data());
            if (mSurface == EGL_NO_SURFACE) {
                fail(description(), "neither EGL_KHR_surfaceless_context nor a pbuffer");
            }
        }
    }

    [[nodiscard]] EGLConfig chooseConfig() const {
        constexpr std::array<EGLint, 5> kAttributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                                    EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglApi().chooseConfig(mDisplay->get(), kAttributes.data(), &config, 1, &count) ||
            count < 1) {
            fail(description(), "no configuration for OpenGL");
        }
        return config;
    }

    void destroy() noexcept {
        retire();
        const EglApi& egl = eglApi();
        if (mSurface != EGL_NO_SURFACE) {
            egl.destroySurface(mDisplay->get(), mSurface);
        }
        if (mContext != EGL_NO_CONTEXT) {
            egl.destroyContext(mDisplay->get(), mContext);
        }
    }

    void bind() override {
        const EglApi& egl = eglApi();
        egl.bindApi(EGL_OPENGL_API); // is a state of the thread, which others may have changed
        if (!egl.makeCurrent(mDisplay->get(), mSurface, mSurface, mContext)) {
            fail(description(), "eglMakeCurrent failed");
        }
    }

    void unbind() noexcept override {
        const EglApi& egl = eglApi();
        egl.bindApi(EGL_OPENGL_API);
        egl.makeCurrent(mDisplay->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    std::shared_ptr<SharedDisplay> mDisplay;
    EGLContext mContext = EGL_NO_CONTEXT;
    EGLSurface mSurface = EGL_NO_SURFACE;
};

ContextCandidate candidate(std::string name, EGLenum platform, void* native, bool software) {
    return {name, ContextKind::Egl, software, [name, platform, native] {
                return std::make_unique<EglContext>(name, platform, native);
            }};
}

ContextCandidate refused(std::string name, std::string reason) {
    return {name, ContextKind::Egl, true,
            [name, reason = std::move(reason)]() -> std::unique_ptr<Context> {
                throw ContextError(name, reason);
            }};
}

} // namespace

std::vector<ContextCandidate> eglCandidates() {
    const EglApi& egl = eglApi();
    if (!egl.library.reason().empty()) {
        return {refused("egl", egl.library.reason())};
    }
    if (egl.getPlatformDisplay == nullptr) {
        return {refused("egl", "libEGL.so.1 has no EGL_EXT_platform_base")};
    }
    std::vector<ContextCandidate> hardware;
    std::vector<ContextCandidate> software;
    if (egl.queryDevices != nullptr && egl.queryDeviceString != nullptr &&
        egl.has("EGL_EXT_platform_device")) {
        EGLint count = 0;
        egl.queryDevices(0, nullptr, &count);
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(std::max(count, 0)));
        egl.queryDevices(count, devices.data(), &count);
        devices.resize(static_cast<std::size_t>(std::max(count, 0)));
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const char* text = egl.queryDeviceString(devices[i], EGL_EXTENSIONS);
            const bool isSoftware = text != nullptr && listHas(text, "EGL_MESA_device_software");
            (isSoftware ? software : hardware)
                .push_back(candidate(fmt::format("egl (device {})", i), EGL_PLATFORM_DEVICE_EXT,
                                     devices[i], isSoftware));
        }
    }
    // Surfaceless is Mesa's: beside another vendor's GPU it gives a software renderer, so the
    // devices come first.
    std::vector<ContextCandidate> candidates = std::move(hardware);
    candidates.push_back(
        egl.has("EGL_MESA_platform_surfaceless")
            ? candidate("egl (surfaceless)", EGL_PLATFORM_SURFACELESS_MESA, nullptr, false)
            : refused("egl (surfaceless)", "libEGL.so.1 has no EGL_MESA_platform_surfaceless"));
    for (ContextCandidate& device : software) {
        candidates.push_back(std::move(device));
    }
    return candidates;
}

} // namespace celadon::gl
