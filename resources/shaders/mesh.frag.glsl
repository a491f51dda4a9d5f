// SPDX-License-Identifier: Apache-2.0
// Skin under studio lights, with a map in colour over it.
#include "scene.glsl"
#include "lighting.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 colour;
layout(binding = 3) uniform sampler2D baseTexture;
layout(binding = 4) uniform sampler2D overlayMap;
uniform vec3 baseColour;
uniform int textured;       // 0: no texture, 1: linear texels, 2: texels in sRGB
uniform int textureFlipped;
uniform float overlayOpacity;  // 0: no map
uniform int overlayFlipped;
uniform int overlayColours;    // the map holds colours
uniform float overlayRange;

vec3 linearFromSrgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Row 0 of an image is its top, where v is 1.
vec2 place(vec2 at, int flipped) { return flipped != 0 ? at : vec2(at.x, 1.0 - at.y); }

// Few to many: deep blue, teal, green, yellow, red. Even steps in lightness, so that it reads without colour too.
vec3 heat(float x) {
    const vec3 ramp[6] = vec3[](vec3(0.020, 0.022, 0.075), vec3(0.022, 0.105, 0.330), vec3(0.020, 0.330, 0.360),
                                vec3(0.170, 0.560, 0.150), vec3(0.930, 0.690, 0.090), vec3(0.880, 0.190, 0.060));
    float place = clamp(x, 0.0, 1.0) * 5.0;
    int low = min(int(place), 4);
    return mix(ramp[low], ramp[low + 1], place - float(low));
}

void main() {
    vec3 toEye = normalize(scene.eye.xyz - position);
    vec3 n = normalize(normal);
    if (dot(n, toEye) < 0.0 && !gl_FrontFacing) n = -n;
    vec3 base = baseColour;
    if (textured != 0) {
        vec3 texel = texture(baseTexture, place(uv, textureFlipped)).rgb;
        base *= textured == 2 ? linearFromSrgb(texel) : texel;
    }
    if (overlayOpacity > 0.0) {
        vec3 texel = texture(overlayMap, place(uv, overlayFlipped)).rgb;
        vec3 shown = overlayColours != 0 ? texel : heat(texel.r / overlayRange);
        base = mix(base, shown, overlayOpacity);
    }
    vec4 ambient = ambientLight(position + n * 0.004);
    // Light that falls through hair reddens and spreads; skin below stays visible.
    float key = meshLight(position, n) * hairLight(position + n * 0.001);
    // Skin scatters: the shadow edge is soft and warm.
    float facing = dot(n, scene.keyDirection.xyz);
    vec3 wrap = vec3(0.34, 0.22, 0.18);
    vec3 diffuse = clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0);
    diffuse *= diffuse;
    vec3 light = scene.keyColour.rgb * key * diffuse;
    light += scene.fillColour.rgb * ambient.w * clamp(dot(n, scene.fillDirection.xyz) * 0.6 + 0.4, 0.0, 1.0);
    light += scene.rimColour.rgb * ambient.w * clamp(dot(n, scene.rimDirection.xyz), 0.0, 1.0);
    light += hemisphere(n) * scene.hair.w * ambient.w;
    vec3 lit = base * light;
    // A broad, weak sheen, stronger at grazing angles.
    vec3 halfway = normalize(scene.keyDirection.xyz + toEye);
    float fresnel = 0.035 + 0.5 * pow(1.0 - clamp(dot(n, toEye), 0.0, 1.0), 5.0);
    float sheen = pow(clamp(dot(n, halfway), 0.0, 1.0), 22.0) * 1.6 * key * clamp(facing * 4.0, 0.0, 1.0);
    lit += scene.keyColour.rgb * sheen * fresnel;
    lit += hemisphere(reflect(-toEye, n)) * fresnel * 0.35 * ambient.w * ambient.w;
    colour = vec4(lit, 1.0);
}
