// SPDX-License-Identifier: Apache-2.0
// Guides as smooth lines, or the discs at their roots (ROOTS). Point i and i + 1 are joined unless i + 1 is a root.
#include "scene.glsl"
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };  // w: 0 at the root to 1 at the tip
layout(location = 0) out vec3 across;  // pixels from the middle (x, y), half width
layout(location = 1) out float along;
layout(location = 2) out float opacity;
uniform float halfWidth;
uniform float shownHeight;  // pixels of the picture when shown: it may be drawn smaller
uniform vec3 brush;         // shares of the picture from the bottom left; radius, 0 without a brush
uniform float opacityNear;
uniform float opacityFar;

float opacityAt(vec4 clip) {
    vec2 pixel = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * scene.viewport.xy;
    float reach = brush.z * scene.viewport.y;
    float near = 1.0 - smoothstep(reach, reach * 1.6 + 8.0, distance(pixel, brush.xy * scene.viewport.xy));
    return mix(opacityFar, opacityNear, brush.z > 0.0 ? near : 0.0);
}

void main() {
    uint index = uint(gl_VertexID) / 6u;
    uint corner = uint(gl_VertexID) % 6u;
    float end = (corner == 1u || corner >= 4u) ? 1.0 : 0.0;
    float side = (corner == 2u || corner == 3u || corner == 5u) ? 1.0 : -1.0;
    float thick = max(halfWidth * scene.viewport.y / shownHeight, 0.4);
    float reach = thick + 1.0;
    vec4 a = points[index];
#ifdef ROOTS
    bool shown = a.w == 0.0;
    vec4 clip = scene.clipFromGroom * vec4(a.xyz, 1.0);
    vec2 offset = vec2(end * 2.0 - 1.0, side) * reach;
    along = 0.0;
    across = vec3(offset, thick);
#else
    vec4 b = points[index + 1u];
    bool shown = b.w > 0.0;
    vec4 clipA = scene.clipFromGroom * vec4(a.xyz, 1.0);
    vec4 clipB = scene.clipFromGroom * vec4(b.xyz, 1.0);
    vec2 direction = (clipB.xy / max(clipB.w, 1e-6) - clipA.xy / max(clipA.w, 1e-6)) * scene.viewport.xy;
    float size = length(direction);
    direction = size > 1e-6 ? direction / size : vec2(1.0, 0.0);
    vec4 clip = end > 0.5 ? clipB : clipA;
    vec2 offset = vec2(-direction.y, direction.x) * side * reach;
    along = end > 0.5 ? b.w : a.w;
    across = vec3(side * reach, 0.0, thick);
    shown = shown && clipA.w > 1e-4 && clipB.w > 1e-4;
#endif
    opacity = opacityAt(clip);
    // A little towards the eye, so that lines lie on the skin and not in it.
    clip.z -= 0.0004 * clip.w;
    gl_Position = shown ? vec4(clip.xy + offset * 2.0 * scene.viewport.zw * clip.w, clip.zw) : vec4(2.0, 2.0, 2.0, 1.0);
}
