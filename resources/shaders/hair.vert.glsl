// SPDX-License-Identifier: Apache-2.0
// Camera-facing ribbons, six vertices a segment, far segments first. Neighbours share their edge exactly.
#include "scene.glsl"
struct Point {
    vec4 clip;
    uvec4 bits;
};
layout(std430, binding = 5) readonly buffer Points { Point points[]; };
layout(std430, binding = 6) readonly buffer Order { uint order[]; };
uniform uint pointsPerHair;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec2 across;  // pixels from the middle, half width

void main() {
    uint segment = order[gl_VertexID / 6];
    uint corner = uint(gl_VertexID % 6);
    uint hair = segment / (pointsPerHair - 1u);
    uint index = segment + hair + ((corner == 1u || corner >= 4u) ? 1u : 0u);
    Point point = points[index];
    vec2 size = unpackHalf2x16(point.bits.y);
    float side = (corner == 2u || corner == 3u || corner == 5u) ? 1.0 : -1.0;
    float reach = (size.x + scene.pixel.z) * side;
    colour = vec4(unpackHalf2x16(point.bits.z), unpackHalf2x16(point.bits.w).x, size.y);
    across = vec2(reach, size.x);
    gl_Position = point.clip;
    gl_Position.xy += unpackSnorm2x16(point.bits.x) * reach * 2.0 * scene.viewport.zw * point.clip.w;
}
