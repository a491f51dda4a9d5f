// SPDX-License-Identifier: Apache-2.0
// Exposure, tone curve, sRGB encoding and a dither of half a step against bands.
layout(location = 0) out vec4 colour;
layout(binding = 0) uniform sampler2D picture;
uniform float exposure;

// Straight up to 0.6, then a shoulder that reaches 1 at infinity: paper colours stay true, highlights do not clip.
vec3 tone(vec3 x) {
    const float knee = 0.6;
    vec3 over = max(x - knee, 0.0);
    return min(x, knee) + (1.0 - knee) * over / (over + (1.0 - knee));
}

vec3 srgbFromLinear(vec3 c) {
    // 1.055 x^(1/2.4) - 0.055 from square roots, within half a step of 8 bits: a power is slow without a card.
    vec3 a = sqrt(c);
    vec3 b = sqrt(a);
    vec3 d = sqrt(b);
    vec3 curve = 0.662002687 * a + 0.684122060 * b - 0.323583601 * d - 0.0225411470 * c;
    return mix(c * 12.92, curve, greaterThan(c, vec3(0.0031308)));
}

float dither(uvec2 pixel) {
    uint h = pixel.x * 1664525u + pixel.y * 1013904223u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return float((h ^ (h >> 15)) >> 8) / 16777216.0 - 0.5;
}

void main() {
    vec3 linear = max(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, 0.0) * exposure;
    colour = vec4(srgbFromLinear(tone(linear)) + dither(uvec2(gl_FragCoord.xy)) / 255.0, 1.0);
}
