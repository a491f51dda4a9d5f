// SPDX-License-Identifier: Apache-2.0
// Move-only owners of OpenGL objects, made and filled by direct state access. Names never leave this folder.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

// All of this needs a current OpenGL 4.5 context, the same for the life of an object. Default-made owners hold nothing.

namespace whorl::gl {

/// An OpenGL name that moves and is deleted once.
class Name {
public:
    using Delete = void (*)(unsigned);
    Name() = default;
    Name(unsigned name, Delete remove) : m_name(name), m_delete(remove) {}
    Name(Name&& other) noexcept : m_name(std::exchange(other.m_name, 0)), m_delete(other.m_delete) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(m_name, other.m_name);
        std::swap(m_delete, other.m_delete);
        return *this;
    }
    ~Name() {
        if (m_name != 0) m_delete(m_name);
    }
    unsigned get() const { return m_name; }
    explicit operator bool() const { return m_name != 0; }

private:
    unsigned m_name = 0;
    Delete m_delete = nullptr;
};

/// Memory of the graphics card.
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::string_view label);

    /// Replaces the whole content; any size, also none.
    void upload(const void* data, std::size_t bytes);
    template <class T>
    void upload(std::span<const T> data) {
        upload(data.data(), data.size_bytes());
    }
    template <class T, class Memory>
    void upload(const std::vector<T, Memory>& data) {
        upload(data.data(), data.size() * sizeof(T));
    }
    /// Room for at least `bytes`; the content is undefined afterwards when it grew.
    void reserve(std::size_t bytes);
    /// Overwrites a part inside the present size.
    void update(std::size_t offset, const void* data, std::size_t bytes);
    /// Waits for what is drawn and copies the first `bytes`, which shaders wrote.
    void read(void* data, std::size_t bytes) const;
    void bindStorage(unsigned index) const;
    void bindUniform(unsigned index) const;
    void bindIndices() const;
    std::size_t size() const { return m_size; }

private:
    friend class VertexArray;
    Name m_name;
    std::size_t m_size = 0;
};

enum class Format {
    R8,
    R16,
    R32F,
    Rgb8,
    Rgb8Srgb,
    Rgba8Srgb,
    Rgb16,
    Rgb32F,
    Rgba8,
    Rgba16F,
    Rgba16,
    Depth24,
    Depth32F
};
enum class Wrap { Clamp, Repeat };

/// A texture in two or three dimensions, or a multisampled one.
class Texture {
public:
    Texture() = default;
    /// Linear filtering; `mipmaps` also between levels. samples > 1: no data, no filtering.
    static Texture make2D(std::string_view label, Format format, glm::ivec2 size, Wrap wrap, bool mipmaps = false,
                          int samples = 1);
    static Texture make3D(std::string_view label, Format format, glm::ivec3 size);

    /// Rows of `rowTexels` texels in memory (0: as wide as the region), channels as in the format, of the type that
    /// `Format` names (R8 bytes, R16 shorts, F floats).
    void upload(glm::ivec2 offset, glm::ivec2 size, const void* texels, int rowTexels = 0);
    /// The same for one of the smaller versions of a texture with mipmaps; level 0 is the texture itself.
    void uploadLevel(int level, glm::ivec2 offset, glm::ivec2 size, const void* texels, int rowTexels = 0);
    void upload3D(const void* texels);
    void makeMipmaps();
    /// Waits for what is drawn and copies all texels, rows from the bottom. Not of multisampled textures.
    void read(void* texels, std::size_t bytes) const;
    /// Depth textures: sampling compares (sampler2DShadow).
    void compareDepth();
    void bind(unsigned unit) const;
    explicit operator bool() const { return static_cast<bool>(m_name); }
    glm::ivec3 size() const { return m_size; }

private:
    friend class Framebuffer;
    Name m_name;
    Format m_format = Format::R8;
    glm::ivec3 m_size{0};
};

/// What is drawn into: owned textures, or none of them for depth only.
class Framebuffer {
public:
    Framebuffer() = default;
    /// `colour` may be null. Both textures must outlive it and have one size.
    Framebuffer(std::string_view label, const Texture* colour, const Texture* depth);
    /// Draws go here, over the whole size.
    void bind() const;
    /// Copies (and resolves) colour, and depth if wanted, to another of the same size.
    void resolveTo(const Framebuffer& other, bool depth = false) const;
    /// Copies colour, smoothly scaled, to a framebuffer that others own (0: the window).
    void stretchTo(unsigned target, glm::ivec2 size) const;
    void clearColour(glm::vec4 colour) const;
    void clearDepth() const;
    glm::ivec2 size() const { return m_size; }
    explicit operator bool() const { return static_cast<bool>(m_name); }
    /// RGBA bytes, rows from the bottom.
    std::vector<std::uint8_t> readPixels() const;
    /// The name, for Renderer::draw's target only.
    unsigned target() const { return m_name.get(); }

private:
    Name m_name;
    glm::ivec2 m_size{0};
};

/// Measures the time that the card needs between begin and end.
class TimerQuery {
public:
    TimerQuery() = default;
    explicit TimerQuery(std::string_view label);
    void begin();
    void end();
    /// Milliseconds of the last finished measurement; never waits.
    double milliseconds();

private:
    Name m_name;
    double m_last = 0.0;
    std::chrono::steady_clock::time_point m_begin{};
    bool m_pending = false;
    bool m_running = false;
};

}  // namespace whorl::gl
