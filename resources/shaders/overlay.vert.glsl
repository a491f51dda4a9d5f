// SPDX-License-Identifier: Apache-2.0
// Dear ImGui's triangles, in pixels from the top left.
struct Vertex {
    float x, y, u, v;
    uint colour;
};
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
uniform vec2 viewportPixels;
uniform uint firstVertex;
layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 colour;
void main() {
    Vertex vertex = vertices[uint(gl_VertexID) + firstVertex];
    uv = vec2(vertex.u, vertex.v);
    colour = unpackUnorm4x8(vertex.colour);
    gl_Position = vec4(vec2(vertex.x, -vertex.y) / viewportPixels * 2.0 + vec2(-1.0, 1.0), 0.0, 1.0);
}
