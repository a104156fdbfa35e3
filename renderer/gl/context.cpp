#include "renderer/gl/context.h"

#include "renderer/gl/backends.h"
#include "renderer/gl/debug_log.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <iterator>

namespace celadon::gl {

namespace {

thread_local Context* gCurrent = nullptr;

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

bool isSoftwareRenderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> kNames{"llvmpipe", "softpipe", "swrast",
                                                     "Software Rasterizer"};
    for (const std::string_view name : kNames) {
        if (renderer.find(name) != std::string_view::npos) {
            return true;
        }
    }
    return false;
}

void append(std::vector<ContextCandidate>& all, std::vector<ContextCandidate> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

/// In the order in which they are tried.
std::vector<ContextCandidate> candidatesFor(ContextKind kind) {
    std::vector<ContextCandidate> candidates;
    if (kind == ContextKind::Auto || kind == ContextKind::Egl) {
        append(candidates, eglCandidates());
    }
    if (kind == ContextKind::Auto || kind == ContextKind::Glfw) {
        append(candidates, glfwCandidates());
    }
    if (kind == ContextKind::Auto || kind == ContextKind::Osmesa) {
        append(candidates, osmesaCandidates());
    }
    return candidates;
}

/// What ContextError says after the subject; the candidate's name is listed anyway.
std::string reasonOf(const std::exception& error, const std::string& name) {
    std::string reason = error.what();
    if (reason.starts_with(name + ": ")) {
        reason.erase(0, name.size() + 2);
    }
    return reason;
}

/// What the current context lacks of the things that are of use beyond OpenGL 4.5.
std::vector<std::string> missingFeatures() {
    std::vector<std::string> missing;
    struct Format {
        GLenum format;
        const char* text;
    };
    constexpr std::array<Format, 4> kBlended{{{GL_RGBA32F, "GL_RGBA32F"},
                                              {GL_RGBA16F, "GL_RGBA16F"},
                                              {GL_R32F, "GL_R32F"},
                                              {GL_R11F_G11F_B10F, "GL_R11F_G11F_B10F"}}};
    for (const Format& format : kBlended) {
        for (const auto& [query, what] : {std::pair(GL_FRAMEBUFFER_RENDERABLE, "rendering to "),
                                          std::pair(GL_FRAMEBUFFER_BLEND, "blending in ")}) {
            GLint support = GL_NONE;
            glGetInternalformativ(GL_TEXTURE_2D, format.format, static_cast<GLenum>(query), 1,
                                  &support);
            if (support != GL_FULL_SUPPORT) {
                missing.push_back(std::string(support == GL_NONE ? "" : "full-speed ") + what +
                                  format.text);
            }
        }
    }
    std::vector<std::string> present;
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        present.emplace_back(
            reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
    }
    for (const char* wanted :
         {"GL_ARB_shader_viewport_layer_array", "GL_ARB_texture_filter_anisotropic",
          "GL_ARB_fragment_shader_interlock", "GL_NV_shader_atomic_float",
          "GL_KHR_parallel_shader_compile"}) {
        if (std::find(present.begin(), present.end(), wanted) == present.end()) {
            missing.emplace_back(wanted);
        }
    }
    return missing;
}

/// Makes the context that was current at construction current again.
class CurrentKeeper {
public:
    CurrentKeeper() : mBefore(Context::current()) {}
    ~CurrentKeeper() {
        if (mBefore != nullptr) {
            try {
                mBefore->makeCurrent();
            } catch (const Error&) { // it was current a moment ago; nothing to be done here
            }
        }
    }
    CurrentKeeper(const CurrentKeeper&) = delete;
    CurrentKeeper& operator=(const CurrentKeeper&) = delete;

private:
    Context* mBefore;
};

} // namespace

ContextKind parseContextKind(std::string_view word) {
    for (const ContextKind kind :
         {ContextKind::Auto, ContextKind::Glfw, ContextKind::Egl, ContextKind::Osmesa}) {
        if (word == contextKindName(kind)) {
            return kind;
        }
    }
    throw UsageError(fmt::format("context '{}'", word), "no such OpenGL backend",
                     "choose auto, glfw, egl or osmesa");
}

const char* contextKindName(ContextKind kind) {
    switch (kind) {
    case ContextKind::Auto:
        return "auto";
    case ContextKind::Glfw:
        return "glfw";
    case ContextKind::Egl:
        return "egl";
    case ContextKind::Osmesa:
        return "osmesa";
    }
    return "";
}

Context::Context(ContextKind kind, std::string description)
    : mKind(kind), mDescription(std::move(description)), mDebugLog(std::make_shared<DebugLog>()) {
    static std::atomic<std::uint32_t> count = 0;
    mSerial = ++count;
}

Context* Context::current() {
    return gCurrent;
}

void Context::makeCurrent() {
    // The functions of <glad/gl.h> are those of the whole process. Those of one backend serve all
    // of its contexts; another backend has others.
    static GetProcAddress loaded = nullptr;
    if (gCurrent != this) {
        releaseCurrent();
        bind();
        gCurrent = this;
    }
    if (mGetProcAddress != loaded) {
        const int version = gladLoadGL(mGetProcAddress);
        loaded = version != 0 ? mGetProcAddress : nullptr;
    }
}

void Context::initialize(GetProcAddress getProcAddress) {
    mGetProcAddress = getProcAddress;
    makeCurrent();
    if (glad_glGetString == nullptr || glad_glGetIntegerv == nullptr) {
        throw ContextError(mDescription, "the driver's functions cannot be loaded");
    }
    mRenderer = glString(GL_RENDERER);
    mVersion = glString(GL_VERSION);
    int major = 0;
    int minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < kGlMajor * 10 + kGlMinor || glad_glCreateTextures == nullptr) {
        throw ContextError(mDescription, fmt::format("OpenGL {}.{} is needed, '{}' has {}",
                                                     kGlMajor, kGlMinor, mRenderer, mVersion));
    }
    mSoftware = isSoftwareRenderer(mRenderer);
    mDebugLog->attach();
}

void Context::releaseCurrent() noexcept {
    if (gCurrent != nullptr) {
        gCurrent->unbind();
        gCurrent = nullptr;
    }
}

void Context::retire() noexcept {
    if (gCurrent == this) {
        releaseCurrent();
    }
}

std::unique_ptr<Context> createContext(ContextKind kind) {
    Context* const before = Context::current();
    std::unique_ptr<Context> software;
    std::string reasons;
    for (const ContextCandidate& candidate : candidatesFor(kind)) {
        if (software != nullptr && candidate.knownSoftware) {
            continue;
        }
        try {
            Context::releaseCurrent();
            std::unique_ptr<Context> context = candidate.create();
            if (!context->isSoftware()) {
                return context;
            }
            if (software == nullptr) {
                software = std::move(context);
            }
        } catch (const ContextError& error) {
            reasons += reasons.empty() ? "" : "; ";
            reasons += candidate.name + ": " + reasonOf(error, candidate.name);
        }
    }
    if (software == nullptr) {
        if (before != nullptr) {
            before->makeCurrent();
        }
        throw ContextError(fmt::format("no OpenGL {}.{} core context", kGlMajor, kGlMinor), reasons,
                           "install a driver, or libegl1 and libegl-mesa0, or libosmesa6");
    }
    software->makeCurrent();
    return software;
}

std::vector<ContextProbe> probeContexts() {
    struct Limit {
        GLenum name;
        const char* text;
    };
    constexpr std::array<Limit, 12> kLimits{{
        {GL_MAX_TEXTURE_SIZE, "GL_MAX_TEXTURE_SIZE"},
        {GL_MAX_3D_TEXTURE_SIZE, "GL_MAX_3D_TEXTURE_SIZE"},
        {GL_MAX_ARRAY_TEXTURE_LAYERS, "GL_MAX_ARRAY_TEXTURE_LAYERS"},
        {GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, "GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS"},
        {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE"},
        {GL_MAX_UNIFORM_BLOCK_SIZE, "GL_MAX_UNIFORM_BLOCK_SIZE"},
        {GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS, "GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS"},
        {GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, "GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS"},
        {GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, "GL_MAX_COMPUTE_SHARED_MEMORY_SIZE"},
        {GL_MAX_COLOR_ATTACHMENTS, "GL_MAX_COLOR_ATTACHMENTS"},
        {GL_MAX_VIEWPORT_DIMS, "GL_MAX_VIEWPORT_DIMS"},
        {GL_MAX_SAMPLES, "GL_MAX_SAMPLES"},
    }};
    const CurrentKeeper keeper;
    std::vector<ContextProbe> probes;
    for (const ContextCandidate& candidate : candidatesFor(ContextKind::Auto)) {
        ContextProbe probe;
        probe.backend = candidate.name;
        try {
            Context::releaseCurrent();
            const std::unique_ptr<Context> context = candidate.create();
            probe.works = true;
            probe.renderer = context->renderer();
            probe.version = context->version();
            probe.vendor = glString(GL_VENDOR);
            for (const Limit& limit : kLimits) {
                std::array<GLint64, 4> values{}; // GL_MAX_VIEWPORT_DIMS has two
                glGetInteger64v(limit.name, values.data());
                probe.limits.emplace_back(limit.text, values[0]);
            }
            probe.missing = missingFeatures();
        } catch (const ContextError& error) {
            probe.reason = reasonOf(error, candidate.name);
        }
        probes.push_back(std::move(probe));
    }
    return probes;
}

} // namespace celadon::gl
