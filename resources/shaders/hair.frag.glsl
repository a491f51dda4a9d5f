// SPDX-License-Identifier: Apache-2.0
// The ribbon's share of the pixel: a box of its width, seen through a filter of the fringe's width.
#include "scene.glsl"
layout(location = 0) in vec4 colour;
layout(location = 1) in vec2 across;
layout(location = 0) out vec4 result;
void main() {
    float share = clamp((across.y + scene.pixel.z - abs(across.x)) / (2.0 * scene.pixel.z), 0.0, 1.0);
    result = vec4(colour.rgb, colour.a * share);
}
