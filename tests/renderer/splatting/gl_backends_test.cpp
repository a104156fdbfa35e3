// EGL and OSMesa, two ways into the driver in one process, draw the same frame.
#include "subedit/errors.h"
#include "tests/support/frames.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace celadon {
namespace {

/// Null where this machine does not have it.
std::unique_ptr<gl::Context> tryContext(gl::ContextKind kind) {
    try {
        return gl::createContext(kind);
    } catch (const ContextError&) {
        return nullptr;
    }
}

TEST(Backends, EglAndOsmesaAgree) {
    constexpr glm::ivec2 kPicture(96, 72);
    const std::unique_ptr<gl::Context> egl = tryContext(gl::ContextKind::Egl);
    const std::unique_ptr<gl::Context> osmesa = tryContext(gl::ContextKind::Osmesa);
    if (!egl || !osmesa) {
        GTEST_SKIP() << "this machine lacks " << (egl ? "OSMesa" : "EGL");
    }
    const World world = test::makeWorld("builtin:vase", test::chessboardMaterial());
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::array lights{test::frontLight(), test::backLight()};
    FloatImage images[2];
    int next = 0;
    for (gl::Context* const context : {egl.get(), osmesa.get()}) {
        context->makeCurrent();
        FrameSettings settings = test::smallFrame(kPicture, 96);
        settings.specular = true;
        settings.coverageSamples = 4;
        images[next++] = test::renderFrame(*context, world, settings, camera, lights).image;
        EXPECT_TRUE(context->takeDebugMessages().empty());
    }
    const double exitance = test::compareExitance(images[0], images[1]).relativeRmse;
    const double color =
        compareValues(extractLayer(images[0], ""), extractLayer(images[1], "")).relativeRmse;
    fmt::print("[ measured ] EGL ({}) against OSMesa ({}): exitance {:.2g}, color {:.2g}\n",
               egl->renderer(), osmesa->renderer(), exitance, color);
    EXPECT_LT(exitance, test::kBackends);
    EXPECT_LT(color, test::kBackends);
}

} // namespace
} // namespace celadon
