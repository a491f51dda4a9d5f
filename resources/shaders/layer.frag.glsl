// SPDX-License-Identifier: Apache-2.0
// A layer that the processor drew: colours multiplied by opacity, in steps of 1/65535 of the brightest.
layout(location = 0) out vec4 colour;
layout(binding = 0) uniform sampler2D layer;
uniform float brightest;
void main() {
    colour = texelFetch(layer, ivec2(gl_FragCoord.xy), 0) * brightest;
}
