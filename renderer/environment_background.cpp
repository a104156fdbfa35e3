#include "renderer/environment_background.h"

#include "subedit/assert.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <cmath>

namespace celadon {

FloatImage compositeOverEnvironment(FloatImage image, const Environment& environment,
                                    const Camera& camera) {
    CELADON_ASSERT(environment && image.channelIndex("A") == 3);
    const CameraFrame frame = cameraFrame(camera);
    // Half the picture at unit distance; an orthographic view looks one way everywhere.
    const double high =
        camera.orthographicHeight ? 0.0 : std::tan(0.5 * glm::radians(camera.fovYDegrees));
    const double wide = high * image.width / image.height;
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < image.width; ++x) {
            float* const pixel = &image.at(x, y, 0);
            if (pixel[3] >= 1.0f) {
                continue;
            }
            const double right = wide * ((x + 0.5) / image.width * 2.0 - 1.0);
            const double up = high * (1.0 - (y + 0.5) / image.height * 2.0);
            const glm::dvec3 direction =
                glm::normalize(frame.forward + right * frame.right + up * frame.up);
            const glm::vec3 behind =
                environmentRadiance(*environment.map,
                                    turnedBack(direction, environment.turnRadians)) *
                static_cast<float>(environment.strength);
            for (int c = 0; c < 3; ++c) {
                pixel[c] += (1.0f - pixel[3]) * behind[c];
            }
            pixel[3] = 1.0f;
        }
    });
    return image;
}

} // namespace celadon
