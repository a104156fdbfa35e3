#include "renderer/gl/backends.h"
#include "renderer/gl/shared_library.h"
#include "subedit/errors.h"

// glad comes before osmesa.h, which would bring another gl.h.
// clang-format off
#include <glad/gl.h>
#include <GL/osmesa.h>
// clang-format on

#include <array>
#include <cstdint>

namespace celadon::gl {

namespace {

struct OsmesaApi {
    SharedLibrary library{"libOSMesa.so.8"};
    decltype(&OSMesaCreateContextAttribs) createContext = nullptr;
    decltype(&OSMesaDestroyContext) destroyContext = nullptr;
    decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
    decltype(&OSMesaGetProcAddress) getProcAddress = nullptr;

    OsmesaApi() {
        library.load(createContext, "OSMesaCreateContextAttribs");
        library.load(destroyContext, "OSMesaDestroyContext");
        library.load(makeCurrent, "OSMesaMakeCurrent");
        library.load(getProcAddress, "OSMesaGetProcAddress");
    }
};

const OsmesaApi& osmesaApi() {
    static const OsmesaApi api;
    return api;
}

class OsmesaContext final : public Context {
public:
    OsmesaContext() : Context(ContextKind::Osmesa, "osmesa") {
        const OsmesaApi& osmesa = osmesaApi();
        if (!osmesa.library.reason().empty()) {
            throw ContextError(description(), osmesa.library.reason());
        }
        constexpr std::array<int, 9> kAttributes{OSMESA_FORMAT,
                                                 OSMESA_RGBA,
                                                 OSMESA_PROFILE,
                                                 OSMESA_CORE_PROFILE,
                                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                                 kGlMajor,
                                                 OSMESA_CONTEXT_MINOR_VERSION,
                                                 kGlMinor,
                                                 0};
        mContext = osmesa.createContext(kAttributes.data(), nullptr);
        if (mContext == nullptr) {
            throw ContextError(description(), "no OpenGL 4.5 core context");
        }
        try {
            initialize(osmesa.getProcAddress);
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~OsmesaContext() override { destroy(); }

private:
    void destroy() noexcept {
        retire();
        osmesaApi().destroyContext(mContext);
    }

    void bind() override {
        if (!osmesaApi().makeCurrent(mContext, mPixel.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            throw ContextError(description(), "OSMesaMakeCurrent failed");
        }
    }

    void unbind() noexcept override { osmesaApi().makeCurrent(nullptr, nullptr, 0, 0, 0); }

    OSMesaContext mContext = nullptr;
    std::array<std::uint8_t, 4> mPixel{}; ///< the default framebuffer, which nothing is drawn to
};

} // namespace

std::vector<ContextCandidate> osmesaCandidates() {
    return {
        {"osmesa", ContextKind::Osmesa, true, [] { return std::make_unique<OsmesaContext>(); }}};
}

} // namespace celadon::gl
