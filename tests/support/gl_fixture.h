#pragma once

#include "renderer/gl/context.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace celadon::test {

/// The backend that the environment variable CELADON_CONTEXT names (celadon_add_test runs each GL
/// test on EGL and on OSMesa); auto when it is not set.
inline gl::ContextKind testContextKind() {
    const char* const word = std::getenv("CELADON_CONTEXT");
    return word != nullptr ? gl::parseContextKind(word) : gl::ContextKind::Auto;
}

/// A test with a context of its own. It fails when the driver had something to complain about.
/// GL objects of a derived fixture die before the context: base classes outlive members.
class GlTest : public testing::Test {
protected:
    GlTest() : mContext(gl::createContext(testContextKind())) {}

    gl::Context& context() { return *mContext; }

    void TearDown() override {
        for (const std::string& message : mContext->takeDebugMessages()) {
            ADD_FAILURE() << message;
        }
    }

private:
    std::unique_ptr<gl::Context> mContext;
};

} // namespace celadon::test
