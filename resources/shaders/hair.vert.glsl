// SPDX-License-Identifier: Apache-2.0
// Corners of camera-facing ribbons, as hair_points.comp.glsl made them. Neighbouring segments share their edge exactly.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colourIn;
layout(location = 2) in vec2 acrossIn;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec2 across;  // pixels from the middle, half width

void main() {
    colour = colourIn;
    across = acrossIn;
    gl_Position = clip;
}
