// SPDX-License-Identifier: Apache-2.0
// Guides as smooth ribbons through their points, two vertices a point, or the discs at their roots (ROOTS), six
// vertices a root.
#include "scene.glsl"
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };  // w: 0 at the root to 1 at the tip
#ifdef ROOTS
layout(std430, binding = 1) readonly buffer Roots { uint roots[]; };  // indices of their points
#endif
layout(location = 0) out vec3 across;  // pixels from the middle (x, y), half width
layout(location = 1) out float along;
layout(location = 2) out float opacity;
uniform float halfWidth;
uniform float shownHeight;  // pixels of the picture when shown: it may be drawn smaller
uniform vec3 brush;         // shares of the picture from the bottom left; radius, 0 without a brush
uniform float opacityNear;
uniform float opacityFar;
uniform vec2 fade;  // depths between which guides become fainter: those behind the model are not the ones at hand

float opacityAt(vec4 clip) {
    vec2 pixel = (clip.xy / max(clip.w, 1e-6) * 0.5 + 0.5) * scene.viewport.xy;
    float reach = brush.z * scene.viewport.y;
    float near = 1.0 - smoothstep(reach, reach * 1.6 + 8.0, distance(pixel, brush.xy * scene.viewport.xy));
    float behind = smoothstep(fade.x, fade.y, clip.w);
    return mix(opacityFar, opacityNear, brush.z > 0.0 ? near : 0.0) * (1.0 - 0.75 * behind);
}

vec2 pixelAt(vec4 clip) { return clip.xy / max(clip.w, 1e-6) * scene.viewport.xy; }

void main() {
    float thick = max(halfWidth * scene.viewport.y / shownHeight, 0.4);
    float reach = thick + 1.0;
#ifdef ROOTS
    uint corner = uint(gl_VertexID) % 6u;
    float end = (corner == 1u || corner >= 4u) ? 1.0 : -1.0;
    float side = (corner == 2u || corner == 3u || corner == 5u) ? 1.0 : -1.0;
    vec4 clip = scene.clipFromGroom * vec4(points[roots[uint(gl_VertexID) / 6u]].xyz, 1.0);
    vec2 offset = vec2(end, side) * reach;
    along = 0.0;
    across = vec3(offset, thick);
#else
    uint place = uint(gl_VertexID) / 2u;
    float side = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
    vec4 own = points[place];
    vec4 clip = scene.clipFromGroom * vec4(own.xyz, 1.0);
    // Along the guide, from the neighbour before to the one behind; ends have one neighbour.
    uint before = own.w > 0.0 ? place - 1u : place;
    uint behind = min(place + 1u, uint(points.length()) - 1u);
    if (points[behind].w == 0.0) behind = place;
    vec2 from = before != place ? pixelAt(scene.clipFromGroom * vec4(points[before].xyz, 1.0)) : pixelAt(clip);
    vec2 to = behind != place ? pixelAt(scene.clipFromGroom * vec4(points[behind].xyz, 1.0)) : pixelAt(clip);
    vec2 direction = to - from;
    float size = length(direction);
    direction = size > 1e-6 ? direction / size : vec2(1.0, 0.0);
    vec2 offset = vec2(-direction.y, direction.x) * side * reach;
    along = own.w;
    across = vec3(side * reach, 0.0, thick);
#endif
    opacity = opacityAt(clip);
    bool shown = clip.w > 1e-4;
    // A little towards the eye, so that lines lie on the skin and not in it.
    clip.z -= 0.0004 * clip.w;
    gl_Position = shown ? vec4(clip.xy + offset * 2.0 * scene.viewport.zw * clip.w, clip.zw) : vec4(2.0, 2.0, 2.0, 1.0);
}
