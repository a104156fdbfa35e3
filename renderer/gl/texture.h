#pragma once

#include "renderer/gl/handle.h"

#include <glad/gl.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// How the CPU sees a texel of an internal format.
struct PixelFormat {
    int channels = 0;
    GLenum clientFormat = 0; ///< GL_RGBA, GL_RED_INTEGER, GL_DEPTH_COMPONENT, …
    GLenum nativeType = 0;   ///< GL_FLOAT, GL_HALF_FLOAT, GL_UNSIGNED_BYTE, …
    bool integer = false;    ///< no filtering, no conversion to float
    bool depth = false;
    int bytesPerTexel = 0;
};

/// @param internalFormat a sized format such as GL_RGBA32F. Asserts that it is one Celadon knows.
[[nodiscard]] PixelFormat pixelFormat(GLenum internalFormat);
/// "RGBA32F"
[[nodiscard]] const char* formatName(GLenum internalFormat);
/// Levels of a complete pyramid down to one texel, sizes halved and rounded down as GL does.
[[nodiscard]] int fullLevelCount(glm::ivec2 size);

/// A 2D, 2D array or 3D texture of immutable storage. Without a Sampler it is read with the nearest
/// texel, clamped to the edge. A resize is a new object.
class Texture {
public:
    /// Empty; id() is 0.
    Texture() = default;
    /// Content undefined. Sizes and levels are at least 1.
    /// @throws ContextError for a size beyond the driver's limits or its memory
    [[nodiscard]] static Texture make2d(std::string_view label, GLenum internalFormat,
                                        glm::ivec2 size, int levels = 1);
    [[nodiscard]] static Texture makeArray(std::string_view label, GLenum internalFormat,
                                           glm::ivec2 size, int layers, int levels = 1);
    /// Whether makeArray() has a chance: what the driver knows without trying. Nothing is allocated.
    [[nodiscard]] static bool canMakeArray(GLenum internalFormat, glm::ivec2 size, int layers);
    /// Several samples a pixel at fixed places, to be drawn to and fetched, nothing else; one
    /// level. The driver may give more samples, see samples(), up to its limits.
    [[nodiscard]] static Texture makeMultisampled(std::string_view label, GLenum internalFormat,
                                                  glm::ivec2 size, int samples);
    [[nodiscard]] static Texture make3d(std::string_view label, GLenum internalFormat,
                                        glm::ivec3 size, int levels = 1);

    /// Some levels of this texture as one of their own, level 0 being `firstLevel`. The texels are
    /// shared, and live as long as either. A pass reads one level so while it writes another.
    [[nodiscard]] Texture viewLevels(std::string_view label, int firstLevel, int levels = 1) const;
    /// One layer of an array as a 2D texture.
    [[nodiscard]] Texture viewLayer(std::string_view label, int layer) const;

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    explicit operator bool() const { return static_cast<bool>(mHandle); }
    [[nodiscard]] const std::string& label() const { return mLabel; }
    [[nodiscard]] GLenum target() const { return mTarget; }
    [[nodiscard]] GLenum format() const { return mFormat; }
    [[nodiscard]] int channels() const { return pixelFormat(mFormat).channels; }
    [[nodiscard]] int levels() const { return mLevels; }
    /// Samples a pixel; 1 unless multisampled.
    [[nodiscard]] int samples() const;
    /// Width, height and depth of a level; layers of an array do not shrink. 2D: depth 1.
    [[nodiscard]] glm::ivec3 size(int level = 0) const;
    [[nodiscard]] glm::ivec2 size2d(int level = 0) const { return glm::ivec2(size(level)); }
    [[nodiscard]] std::size_t texelCount(int level = 0) const;

    /// All texels of a level, rows from the texture's row 0, channel fastest. The element type is
    /// the client's: floats are converted to half or normalized formats by the driver; formats of
    /// integers take the integer types only. The count of elements must be texels × channels.
    void upload(int level, std::span<const float> texels);
    void upload(int level, std::span<const std::uint8_t> texels);
    void upload(int level, std::span<const std::uint16_t> texels); ///< half bits for a half format
    void upload(int level, std::span<const std::uint32_t> texels);
    void upload(int level, std::span<const std::int32_t> texels);
    /// A box of a level (z: slice or layer).
    void uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                      std::span<const float> texels);
    void uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                      std::span<const std::uint8_t> texels);
    void uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                      std::span<const std::uint16_t> texels);

    /// Waits for the GPU and copies a level out, as it would be uploaded. For integer formats use
    /// the integer forms.
    [[nodiscard]] std::vector<float> readLevel(int level = 0) const;
    [[nodiscard]] std::vector<std::uint32_t> readLevelUint(int level = 0) const;
    [[nodiscard]] std::vector<std::int32_t> readLevelInt(int level = 0) const;
    /// The same into memory of the caller; no allocation.
    void readLevel(int level, std::span<float> texels) const;
    /// A box of a level: the texel under the cursor, one layer.
    [[nodiscard]] std::vector<float> readRegion(int level, glm::ivec3 offset,
                                                glm::ivec3 extent) const;
    void readRegion(int level, glm::ivec3 offset, glm::ivec3 extent, std::span<float> texels) const;
    /// Of a half format, its bits.
    void readRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                    std::span<std::uint16_t> texels) const;

    void clear(int level, glm::vec4 value); ///< float, normalized and depth (x) formats
    void clear(int level, glm::uvec4 value);
    void clear(int level, glm::ivec4 value);
    /// The driver's box filter; not for buffers with a background.
    void generateMipmaps();

    /// To texture unit `unit` (layout(binding = unit) uniform sampler…).
    void bind(GLuint unit) const;
    /// @param access GL_READ_ONLY, GL_WRITE_ONLY or GL_READ_WRITE
    /// @param layer  one layer or slice, or -1 for all
    void bindImage(GLuint unit, int level, GLenum access, int layer = -1) const;

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    };

    static Texture make(std::string_view label, GLenum target, GLenum internalFormat,
                        glm::ivec3 size, int levels, int samples = 1);
    [[nodiscard]] Texture view(std::string_view label, GLenum target, int firstLevel, int levels,
                               int firstLayer, int layers) const;
    void applyDefaultSampling();
    void uploadBytes(int level, glm::ivec3 offset, glm::ivec3 extent, GLenum type, const void* data,
                     std::size_t elements);
    void readBytes(int level, glm::ivec3 offset, glm::ivec3 extent, GLenum type, void* data,
                   std::size_t elements, std::size_t bytes) const;
    void clearBytes(int level, GLenum type, const void* value);

    Handle<Traits> mHandle;
    std::string mLabel;
    GLenum mTarget = 0;
    GLenum mFormat = 0;
    glm::ivec3 mSize{0};
    int mLevels = 0;
};

} // namespace celadon::gl
