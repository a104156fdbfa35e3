#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// OpenGL 4.5 core contexts without a visible window: EGL (surfaceless, device), OSMesa and GLFW's
/// hidden window, chosen at run time in one program.
namespace celadon::gl {

enum class ContextKind { Auto, Glfw, Egl, Osmesa };

/// @throws UsageError for another word than auto|glfw|egl|osmesa
[[nodiscard]] ContextKind parseContextKind(std::string_view word);
[[nodiscard]] const char* contextKindName(ContextKind kind);

/// A current OpenGL 4.5 core context with debug output on. The functions of <glad/gl.h> are loaded.
/// Owners of GL objects keep it alive; it is made current on the thread that created it. The loaded
/// functions belong to the process, so several contexts may live at once, but on one thread only.
class Context {
public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    [[nodiscard]] ContextKind kind() const { return mKind; }
    /// "egl (surfaceless)", "egl (device 1)", "osmesa", "glfw"
    [[nodiscard]] const std::string& description() const { return mDescription; }
    [[nodiscard]] const std::string& renderer() const { return mRenderer; } ///< GL_RENDERER
    [[nodiscard]] const std::string& version() const { return mVersion; }   ///< GL_VERSION
    /// llvmpipe, softpipe, swrast: no GPU behind it; timer queries do not measure there.
    [[nodiscard]] bool isSoftware() const { return mSoftware; }

    /// Nothing happens when it is current already. Whatever context was current is released first:
    /// two backends may share the driver's notion of "current" (OSMesa and EGL of Mesa do).
    void makeCurrent();
    /// The context that is current on this thread, or null.
    [[nodiscard]] static Context* current();
    /// Leaves no context current on this thread. Needed before another library makes one current
    /// (glfwCreateWindow does), which drivers refuse while a context of EGL is.
    static void releaseCurrent() noexcept;
    /// Number of this context, unique in the process and never 0. GL names are only unique within a
    /// context; owners of GL objects remember it.
    [[nodiscard]] std::uint32_t serial() const { return mSerial; }

    /// Messages of KHR_debug with severity medium or high since the last call; empty in a sound
    /// program.
    [[nodiscard]] std::vector<std::string> takeDebugMessages();

protected:
    using GetProcAddress = void (*(*)(const char*))();

    Context(ContextKind kind, std::string description);
    /// Called by each backend once its context can be bound: makes it current, loads functions,
    /// reads strings, starts debug output.
    /// @throws ContextError for less than OpenGL 4.5
    void initialize(GetProcAddress getProcAddress);
    /// Called first by each backend's destructor, while it can still unbind.
    void retire() noexcept;

private:
    /// Makes the backend's context current on this thread. @throws ContextError
    virtual void bind() = 0;
    virtual void unbind() noexcept = 0;

    ContextKind mKind;
    std::string mDescription;
    std::string mRenderer;
    std::string mVersion;
    bool mSoftware = true;
    std::uint32_t mSerial;
    GetProcAddress mGetProcAddress = nullptr;
    struct DebugLog;
    std::shared_ptr<DebugLog> mDebugLog;
};

/// `Auto` prefers a GPU (EGL devices first, then GLFW), then software EGL, then OSMesa.
/// @throws ContextError: one line that lists each backend tried with its reason
[[nodiscard]] std::unique_ptr<Context> createContext(ContextKind kind);

/// One entry per backend (and per EGL device), for `celadon info --system`.
struct ContextProbe {
    std::string backend;
    bool works = false;
    std::string reason; ///< why not, when it does not
    std::string renderer, version, vendor;
    std::vector<std::pair<std::string, long long>> limits; ///< GL name -> value
    std::vector<std::string> missing; ///< extensions or formats that Celadon would like
};
[[nodiscard]] std::vector<ContextProbe> probeContexts();

} // namespace celadon::gl
