// SPDX-License-Identifier: Apache-2.0
#include "render/gl/objects.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

namespace whorl::gl {
namespace {

void label(GLenum kind, unsigned name, std::string_view text) {
    glObjectLabel(kind, name, static_cast<GLsizei>(text.size()), text.data());
}

struct FormatInfo {
    GLenum internal;
    GLenum channels;
    GLenum type;
};

FormatInfo info(Format format) {
    switch (format) {
        case Format::R8:
            return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
        case Format::R16:
            return {GL_R16, GL_RED, GL_UNSIGNED_SHORT};
        case Format::R32F:
            return {GL_R32F, GL_RED, GL_FLOAT};
        case Format::Rgb8:
            return {GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE};
        case Format::Rgb8Srgb:
            return {GL_SRGB8, GL_RGB, GL_UNSIGNED_BYTE};
        case Format::Rgba8Srgb:
            return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::Rgb16:
            return {GL_RGB16, GL_RGB, GL_UNSIGNED_SHORT};
        case Format::Rgb32F:
            return {GL_RGB32F, GL_RGB, GL_FLOAT};
        case Format::Rgba8:
            return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::Rgba16F:
            return {GL_RGBA16F, GL_RGBA, GL_FLOAT};
        case Format::Rgba16:
            return {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT};
        case Format::Depth24:
            return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
        case Format::Depth32F:
            return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
    }
    return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
}

int levelsOf(glm::ivec2 size) {
    int levels = 1;
    for (int side = std::max(size.x, size.y); side > 1; side /= 2) ++levels;
    return levels;
}

void deleteBuffer(unsigned name) {
    glDeleteBuffers(1, &name);
}
void deleteTexture(unsigned name) {
    glDeleteTextures(1, &name);
}
void deleteFramebuffer(unsigned name) {
    glDeleteFramebuffers(1, &name);
}
void deleteQuery(unsigned name) {
    glDeleteQueries(1, &name);
}

}  // namespace

Buffer::Buffer(std::string_view text) {
    unsigned name = 0;
    glCreateBuffers(1, &name);
    m_name = Name(name, deleteBuffer);
    label(GL_BUFFER, name, text);
}

void Buffer::upload(const void* data, std::size_t bytes) {
    if (bytes == m_size && bytes > 0) {
        glNamedBufferSubData(m_name.get(), 0, static_cast<GLsizeiptr>(bytes), data);
        return;
    }
    // A buffer without storage can not be bound to a shader: keep at least one vector.
    glNamedBufferData(m_name.get(), static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16)),
                      bytes >= 16 ? data : nullptr, GL_DYNAMIC_DRAW);
    if (bytes > 0 && bytes < 16) glNamedBufferSubData(m_name.get(), 0, static_cast<GLsizeiptr>(bytes), data);
    m_size = bytes;
}

void Buffer::reserve(std::size_t bytes) {
    if (bytes <= m_size && m_size > 0) return;
    m_size = std::max<std::size_t>(bytes, 16);
    glNamedBufferData(m_name.get(), static_cast<GLsizeiptr>(m_size), nullptr, GL_DYNAMIC_DRAW);
}

void Buffer::update(std::size_t offset, const void* data, std::size_t bytes) {
    assert(offset + bytes <= m_size);
    if (bytes > 0) {
        glNamedBufferSubData(m_name.get(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
    }
}

void Buffer::read(void* data, std::size_t bytes) const {
    assert(bytes <= m_size);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (bytes > 0) glGetNamedBufferSubData(m_name.get(), 0, static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::bindStorage(unsigned index) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, index, m_name.get());
}
void Buffer::bindUniform(unsigned index) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, index, m_name.get());
}
void Buffer::bindIndices() const {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m_name.get());
}

Texture Texture::make2D(std::string_view text, Format format, glm::ivec2 size, Wrap wrap, bool mipmaps, int samples) {
    Texture texture;
    texture.m_format = format;
    texture.m_size = glm::ivec3(size.x, size.y, 1);
    unsigned name = 0;
    glCreateTextures(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &name);
    texture.m_name = Name(name, deleteTexture);
    label(GL_TEXTURE, name, text);
    if (samples > 1) {
        glTextureStorage2DMultisample(name, samples, info(format).internal, size.x, size.y, GL_TRUE);
        return texture;
    }
    glTextureStorage2D(name, mipmaps ? levelsOf(size) : 1, info(format).internal, size.x, size.y);
    const auto wrapMode = static_cast<GLint>(wrap == Wrap::Repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, wrapMode);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, wrapMode);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    return texture;
}

Texture Texture::make3D(std::string_view text, Format format, glm::ivec3 size) {
    Texture texture;
    texture.m_format = format;
    texture.m_size = size;
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    texture.m_name = Name(name, deleteTexture);
    label(GL_TEXTURE, name, text);
    glTextureStorage3D(name, 1, info(format).internal, size.x, size.y, size.z);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(name, axis, static_cast<GLint>(GL_CLAMP_TO_EDGE));
    }
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return texture;
}

void Texture::upload(glm::ivec2 offset, glm::ivec2 size, const void* texels, int rowTexels) {
    uploadLevel(0, offset, size, texels, rowTexels);
}

void Texture::uploadLevel(int level, glm::ivec2 offset, glm::ivec2 size, const void* texels, int rowTexels) {
    const FormatInfo format = info(m_format);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, rowTexels);
    glTextureSubImage2D(m_name.get(), level, offset.x, offset.y, size.x, size.y, format.channels, format.type, texels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void Texture::upload3D(const void* texels) {
    const FormatInfo format = info(m_format);
    glTextureSubImage3D(m_name.get(), 0, 0, 0, 0, m_size.x, m_size.y, m_size.z, format.channels, format.type, texels);
}

void Texture::read(void* texels, std::size_t bytes) const {
    const FormatInfo format = info(m_format);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(m_name.get(), 0, format.channels, format.type, static_cast<GLsizei>(bytes), texels);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

void Texture::makeMipmaps() {
    glGenerateTextureMipmap(m_name.get());
}

void Texture::compareDepth() {
    glTextureParameteri(m_name.get(), GL_TEXTURE_COMPARE_MODE, static_cast<GLint>(GL_COMPARE_REF_TO_TEXTURE));
    glTextureParameteri(m_name.get(), GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(GL_LEQUAL));
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, m_name.get());
}

Framebuffer::Framebuffer(std::string_view text, const Texture* colour, const Texture* depth) {
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    m_name = Name(name, deleteFramebuffer);
    label(GL_FRAMEBUFFER, name, text);
    if (colour != nullptr) {
        glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour->m_name.get(), 0);
        m_size = glm::ivec2(colour->m_size.x, colour->m_size.y);
    } else {
        glNamedFramebufferDrawBuffer(name, GL_NONE);
        glNamedFramebufferReadBuffer(name, GL_NONE);
    }
    if (depth != nullptr) {
        glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->m_name.get(), 0);
        m_size = glm::ivec2(depth->m_size.x, depth->m_size.y);
    }
    assert(glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, m_name.get());
    glViewport(0, 0, m_size.x, m_size.y);
}

void Framebuffer::resolveTo(const Framebuffer& other, bool depth) const {
    glBlitNamedFramebuffer(m_name.get(), other.m_name.get(), 0, 0, m_size.x, m_size.y, 0, 0, m_size.x, m_size.y,
                           depth ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::stretchTo(unsigned target, glm::ivec2 size) const {
    glBlitNamedFramebuffer(m_name.get(), target, 0, 0, m_size.x, m_size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT,
                           GL_LINEAR);
}

void Framebuffer::clearColour(glm::vec4 colour) const {
    glClearNamedFramebufferfv(m_name.get(), GL_COLOR, 0, &colour.x);
}

void Framebuffer::clearDepth() const {
    const float farthest = 1.0f;
    glClearNamedFramebufferfv(m_name.get(), GL_DEPTH, 0, &farthest);
}

std::vector<std::uint8_t> Framebuffer::readPixels() const {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(m_size.x) * static_cast<std::size_t>(m_size.y) * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_name.get());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, m_size.x, m_size.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    return pixels;
}

TimerQuery::TimerQuery(std::string_view text) {
    unsigned name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    m_name = Name(name, deleteQuery);
    label(GL_QUERY, name, text);
}

void TimerQuery::begin() {
    milliseconds();
    m_running = !m_pending;
    if (!m_running) return;
    m_begin = std::chrono::steady_clock::now();
    glBeginQuery(GL_TIME_ELAPSED, m_name.get());
}

void TimerQuery::end() {
    if (!m_running) return;
    glEndQuery(GL_TIME_ELAPSED);
    m_running = false;
    m_pending = true;
}

double TimerQuery::milliseconds() {
    if (m_pending) {
        int ready = 0;
        glGetQueryObjectiv(m_name.get(), GL_QUERY_RESULT_AVAILABLE, &ready);
        if (ready != 0) {
            GLuint64 nanoseconds = 0;
            glGetQueryObjectui64v(m_name.get(), GL_QUERY_RESULT, &nanoseconds);
            // llvmpipe counts its first query from zero: no query lasts longer than the time since it began.
            const std::chrono::duration<double, std::milli> most = std::chrono::steady_clock::now() - m_begin;
            m_last = std::min(static_cast<double>(nanoseconds) * 1e-6, most.count());
            m_pending = false;
        }
    }
    return m_last;
}

}  // namespace whorl::gl
