// SPDX-License-Identifier: Apache-2.0
// Hair as lines of one pixel, the usual way: what benchmarks compare with.
#include "scene.glsl"
layout(location = 0) in vec3 position;
void main() { gl_Position = scene.clipFromGroom * vec4(position, 1.0); }
