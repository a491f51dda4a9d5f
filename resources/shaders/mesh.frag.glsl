// SPDX-License-Identifier: Apache-2.0
// Skin under studio lights, with a map in colour over it. VERTEX_LIT: the light comes with the vertices. LIC: under hair
// texture.
#if defined(LIC) || !defined(VERTEX_LIT)
#include "skin.glsl"
#endif
#ifdef LIC
#include "lic.glsl"
layout(location = 4) in vec3 tangent;
layout(location = 5) in vec2 licUv;
layout(location = 9) flat in int licTriangle;
#endif
#ifdef VERTEX_LIT
layout(location = 0) in vec3 light;
layout(location = 1) in vec3 gloss;
#ifdef LIC
layout(location = 6) in vec3 position;
layout(location = 7) in vec3 normal;
layout(location = 8) in vec2 arrives;
#endif
#else
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#endif
layout(location = 2) in vec2 uv;
layout(location = 3) flat in vec4 triangleColour;  // opacity last
layout(location = 0) out vec4 colour;
layout(binding = 3) uniform sampler2D baseTexture;
layout(binding = 4) uniform sampler2D overlayMap;
layout(binding = 5) uniform sampler2D groupColours;  // 256 x 1
uniform vec3 baseColour;
uniform int textured;       // 0: no texture, 1: linear texels, 2: texels in sRGB
uniform int textureFlipped;
uniform float overlayOpacity;  // 0: no map
uniform int overlayFlipped;
uniform int overlayColours;    // the map holds colours
uniform int overlayGroups;     // the map holds numbers of groups
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
    vec3 base = baseColour;
    if (textured != 0) {
        vec3 texel = texture(baseTexture, place(uv, textureFlipped)).rgb;
        base *= textured == 2 ? linearFromSrgb(texel) : texel;
    }
    if (overlayOpacity > 0.0) {
        vec3 shown;
        if (overlayGroups != 0) {
            // The nearest texel: between two numbers there is no third.
            ivec2 size = textureSize(overlayMap, 0);
            ivec2 texel = ivec2(fract(place(uv, overlayFlipped)) * vec2(size));
            float number = texelFetch(overlayMap, min(texel, size - 1), 0).r;
            shown = texelFetch(groupColours, ivec2(clamp(number * 255.0 + 0.5, 0.0, 255.0), 0), 0).rgb;
        } else {
            vec3 texel = texture(overlayMap, place(uv, overlayFlipped)).rgb;
            shown = overlayColours != 0 ? texel : heat(texel.r / overlayRange);
        }
        base = mix(base, shown, overlayOpacity);
    }
    base = mix(base, triangleColour.rgb, triangleColour.a);
#if defined(LIC) || !defined(VERTEX_LIT)
    vec3 toEye = normalize(scene.eye.xyz - position);
    vec3 n = normalize(normal);
    if (dot(n, toEye) < 0.0 && !gl_FrontFacing) n = -n;
#endif
#ifdef LIC
    LicHair hair = licHair(licUv, tangent, licTriangle, n, toEye);
    // A map that is painted is seen through the hair that it makes.
    hair.cover *= 1.0 - 0.5 * overlayOpacity;
    vec3 hairColour = vec3(0.0);
    if (hair.cover > 0.0) {
#ifndef VERTEX_LIT
        vec2 arrives = lightArriving(position, n);
#endif
        hairColour = licShade(hair, n, toEye, arrives);
    }
    if (hair.cover >= 1.0) {
        colour = vec4(hairColour, 1.0);
        return;
    }
#endif
#ifndef VERTEX_LIT
    vec3 light;
    vec3 gloss;
    skinLight(position, n, toEye, light, gloss);
#endif
    colour = vec4(base * light + gloss, 1.0);
#ifdef LIC
    colour.rgb = mix(colour.rgb, hairColour, hair.cover);
#endif
}
