// SPDX-License-Identifier: Apache-2.0
#include "render/gl/draw.h"

#include <epoxy/gl.h>

namespace whorl::gl {
namespace {

void deleteVertexArray(unsigned name) {
    glDeleteVertexArrays(1, &name);
}

void enable(GLenum what, bool on) {
    if (on) {
        glEnable(what);
    } else {
        glDisable(what);
    }
}

}  // namespace

Result<ContextInfo> contextInfo() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    ContextInfo facts;
    facts.renderer = text != nullptr ? text : "";
    const int version = epoxy_gl_version();
    if (text == nullptr || !epoxy_is_desktop_gl() || version < 45) {
        return Error{"The graphics driver (" + (facts.renderer.empty() ? "none" : facts.renderer) +
                     ") has no OpenGL 4.5; install a newer driver or Mesa."};
    }
    for (const char* software : {"llvmpipe", "softpipe", "SwiftShader", "Software"}) {
        facts.software = facts.software || facts.renderer.find(software) != std::string::npos;
    }
    glGetIntegerv(GL_MAX_SAMPLES, &facts.maxSamples);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &facts.maxTextureSize);
    return facts;
}

void apply(const DrawState& state) {
    enable(GL_DEPTH_TEST, state.depth != Depth::None);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(state.depth == Depth::TestWrite ? GL_TRUE : GL_FALSE);
    enable(GL_BLEND, state.blend != Blend::None);
    glBlendFuncSeparate(state.blend == Blend::OverPremultiplied ? GL_ONE : GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                        GL_ONE_MINUS_SRC_ALPHA);
    enable(GL_CULL_FACE, state.cullBack);
    glCullFace(GL_BACK);
    enable(GL_POLYGON_OFFSET_FILL, state.slopeBias != 0.0f);
    glPolygonOffset(state.slopeBias, state.slopeBias);
}

VertexArray::VertexArray() {
    unsigned name = 0;
    glCreateVertexArrays(1, &name);
    m_name = Name(name, deleteVertexArray);
}

void VertexArray::attribute(unsigned location, Type type, int count, std::size_t offset) {
    glEnableVertexArrayAttrib(m_name.get(), location);
    glVertexArrayAttribFormat(m_name.get(), location, count, type == Type::Half ? GL_HALF_FLOAT : GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(m_name.get(), location, 0);
}

void VertexArray::bind() const {
    glBindVertexArray(m_name.get());
}

void VertexArray::bind(const Buffer& vertices, std::size_t vertexBytes, const Buffer& indices) const {
    glBindVertexArray(m_name.get());
    glBindVertexBuffer(0, vertices.m_name.get(), 0, static_cast<GLsizei>(vertexBytes));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.m_name.get());
}

void drawTriangles(std::size_t first, std::size_t count) {
    if (count > 0) glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first), static_cast<GLsizei>(count));
}

void drawIndexed16(std::size_t first, std::size_t count) {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_SHORT,
                   reinterpret_cast<const void*>(first * 2));
}

void drawIndexed32(std::size_t count) {
    if (count > 0) glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr);
}

void drawIndexedLines32(std::size_t count) {
    if (count > 0) glDrawElements(GL_LINES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr);
}

void dispatch(std::size_t groups) {
    // One dimension holds at least 65,535 groups; two dimensions hold the rest.
    constexpr std::size_t width = 32768;
    if (groups == 0) return;
    glDispatchCompute(static_cast<GLuint>(std::min(groups, width)), static_cast<GLuint>((groups + width - 1) / width),
                      1);
}

void storageBarrier() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void vertexBarrier() {
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void scissor(glm::ivec4 xywh) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(xywh.x, xywh.y, xywh.z, xywh.w);
}

void noScissor() {
    glDisable(GL_SCISSOR_TEST);
}

void bindTarget(unsigned target, glm::ivec2 size) {
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void restoreState() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    for (GLuint unit = 0; unit < 8; ++unit) glBindTextureUnit(unit, 0);
}

void finish() {
    glFinish();
}

}  // namespace whorl::gl
