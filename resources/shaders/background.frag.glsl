// SPDX-License-Identifier: Apache-2.0
// A studio backdrop: lighter behind the head, darker at the edges.
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 colour;
uniform vec3 centreColour;
uniform float aspect;
void main() {
    vec2 from = (place - vec2(0.5, 0.54)) * vec2(aspect, 1.0);
    float edge = 1.0 / (1.0 + 3.2 * dot(from, from));
    colour = vec4(centreColour * (0.12 + 1.4 * edge * edge), 1.0);
}
