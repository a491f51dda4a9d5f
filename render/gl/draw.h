// SPDX-License-Identifier: Apache-2.0
// Drawing calls and the fixed state that they need.
#pragma once

#include "core/base/result.h"
#include "render/gl/objects.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace whorl::gl {

/// Facts of the current context.
struct ContextInfo {
    std::string renderer;
    bool software = false;  ///< drawn by the processor (llvmpipe, softpipe, SwiftShader)
    int maxSamples = 1;
    int maxTextureSize = 0;
};
/// A sentence when the context is older than OpenGL 4.5. Needs a current context.
Result<ContextInfo> contextInfo();

enum class Blend { None, Over, OverPremultiplied };
enum class Depth { None, Test, TestWrite };

struct DrawState {
    Depth depth = Depth::TestWrite;
    Blend blend = Blend::None;
    bool cullBack = false;
    float slopeBias = 0.0f;  ///< polygon offset, for shadow maps
};
void apply(const DrawState& state);

/// Where vertices come from. Without attributes, shaders pull them from storage buffers by gl_VertexID.
class VertexArray {
public:
    VertexArray();
    enum class Type { Float, Half };
    /// Attribute `location` of `count` numbers at `offset` in each vertex.
    void attribute(unsigned location, Type type, int count, std::size_t offset);
    void bind() const;
    /// Vertices of `vertexBytes` each and 32-bit indices for drawIndexed32.
    void bind(const Buffer& vertices, std::size_t vertexBytes, const Buffer& indices) const;

private:
    Name m_name;
};

void drawTriangles(std::size_t first, std::size_t count);
/// 16-bit indices from the bound index buffer; `first` in indices.
void drawIndexed16(std::size_t first, std::size_t count);
/// Triangles, or lines of one pixel, of 32-bit indices from the vertex array's index buffer.
void drawIndexed32(std::size_t count);
void drawIndexedLines32(std::size_t count);
void dispatch(std::size_t groups);
/// What compute shaders wrote is seen by the shaders that follow.
void storageBarrier();
/// The same for vertices.
void vertexBarrier();
void scissor(glm::ivec4 xywh);
void noScissor();
/// Draws go into a framebuffer that others own (0: the window).
void bindTarget(unsigned target, glm::ivec2 size);
/// As a fresh context has it, for programs that draw after us (Qt).
void restoreState();
/// Waits until all is drawn.
void finish();

}  // namespace whorl::gl
