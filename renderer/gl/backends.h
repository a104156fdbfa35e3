#pragma once

#include "renderer/gl/context.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// What context.cpp asks of each backend; not for others.
namespace celadon::gl {

/// One way to get a context: a platform, or one device of it.
struct ContextCandidate {
    std::string name;           ///< as Context::description() will be
    ContextKind kind;           ///< never Auto
    bool knownSoftware = false; ///< certain before trying, so that a search for a GPU skips it
    std::function<std::unique_ptr<Context>()> create; ///< throws ContextError with the reason
};

/// Best first. A missing library still gives one candidate, whose `create` says why it fails.
[[nodiscard]] std::vector<ContextCandidate> eglCandidates();
[[nodiscard]] std::vector<ContextCandidate> glfwCandidates();
[[nodiscard]] std::vector<ContextCandidate> osmesaCandidates();

/// Every context is asked for this version, core profile.
inline constexpr int kGlMajor = 4;
inline constexpr int kGlMinor = 5;

} // namespace celadon::gl
