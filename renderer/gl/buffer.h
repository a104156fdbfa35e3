#pragma once

#include "renderer/gl/handle.h"

#include <glad/gl.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace celadon::gl {

/// What the CPU does with a buffer, fixed at its creation; the GPU may always read and write it.
enum class BufferUse {
    Device,   ///< nothing after its first content; `read` and `clear` work all the same
    Update,   ///< `write` at any time; the driver orders it after commands already given
    Upload,   ///< written through `mapped()`; the caller keeps off ranges still in use
    Readback, ///< read through `mapped()` once a fence or finish says that the GPU has written
};

/// A buffer of immutable size. A resize is a new object.
class Buffer {
public:
    /// Empty; id() is 0.
    Buffer() = default;
    /// Content undefined. @param bytes may be 0: the buffer can be bound and holds nothing.
    /// @throws ContextError when the memory is not there
    Buffer(std::string_view label, std::size_t bytes, BufferUse use = BufferUse::Device);
    Buffer(std::string_view label, std::span<const std::byte> content,
           BufferUse use = BufferUse::Device);
    /// From a vector, array or span of trivially copyable elements.
    template<class T>
    [[nodiscard]] static Buffer of(std::string_view label, const T& elements,
                                   BufferUse use = BufferUse::Device) {
        return Buffer(label, bytesOf(elements), use);
    }

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    [[nodiscard]] std::size_t sizeBytes() const { return mSize; }
    explicit operator bool() const { return static_cast<bool>(mHandle); }

    /// For BufferUse::Update. The range lies within the buffer.
    void write(std::size_t offsetBytes, std::span<const std::byte> content);
    template<class T>
    void write(const T& elements, std::size_t offsetBytes = 0) {
        write(offsetBytes, bytesOf(elements));
    }

    /// Waits for the GPU and copies a range out.
    void read(std::size_t offsetBytes, std::span<std::byte> destination) const;
    template<class T>
    [[nodiscard]] std::vector<T> read(std::size_t firstElement, std::size_t count) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> elements(count);
        read(firstElement * sizeof(T), std::as_writable_bytes(std::span(elements)));
        return elements;
    }
    template<class T>
    [[nodiscard]] std::vector<T> read() const {
        return read<T>(0, mSize / sizeof(T));
    }

    /// Fills a range with zeros, or all of it with copies of a 32-bit word, on the GPU.
    void clear() { fill(0); }
    void clear(std::size_t offsetBytes, std::size_t bytes);
    void fill(GLuint word);

    /// Persistent, coherent memory of the whole buffer, for Upload and Readback; else empty.
    [[nodiscard]] std::span<std::byte> mapped() const {
        return {mMapped, mMapped != nullptr ? mSize : 0};
    }

    void bindStorage(GLuint binding) const;
    void bindStorage(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const;
    void bindUniform(GLuint binding) const;
    void bindUniform(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const;
    /// @param target GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER …
    void bind(GLenum target) const;

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
    };

    template<class T>
    static std::span<const std::byte> bytesOf(const T& elements) {
        const std::span view(elements);
        static_assert(std::is_trivially_copyable_v<typename decltype(view)::value_type>);
        return std::as_bytes(view);
    }

    void allocate(std::string_view label, const void* content, BufferUse use);
    void bindRange(GLenum target, GLuint binding, std::size_t offsetBytes, std::size_t bytes) const;

    Handle<Traits> mHandle;
    std::size_t mSize = 0;
    std::byte* mMapped = nullptr; ///< unmapped when the buffer is deleted
};

} // namespace celadon::gl
