// SPDX-License-Identifier: Apache-2.0
// Hair texture over the skin, lit from the direction of the hair (seed 002, sections 3.1 and 4). Needs skin.glsl.
//
// A pixel that holds many hairs shows their mean without any being drawn: brightness is linear in the tone of a hair,
// and the halo is a bell whose mean over tones of that variance is known.
layout(binding = 6) uniform sampler2D licTones;    // tone (128/255 is 0), its square, cover, corners on this side (level 0)
layout(binding = 7) uniform sampler2D licColours;
layout(std430, binding = 5) readonly buffer LicUvs { vec2 licUvs[]; };
layout(std430, binding = 6) readonly buffer LicTangents { float licTangents[]; };
uniform vec4 licLight;  // ambient, diffuse, highlight, 1 / shininess
uniform vec4 licTone;   // contrast, shift of the halo, mean of the convolution

struct LicHair {
    vec3 tangent;
    vec3 colour;   // of the mean hair
    float tone;    // mean of the pixel's hairs, -1 dark to 1 light
    float spread;  // their variance
    float grazing; // variance of the angle to the halo over the pixel
    float cover;
    float agreed;  // 1: corners of the triangle point the same way; 0: apart, as on the two sides of a parting
};

float square(float x) { return x * x; }

// Where corners of a triangle point apart, a parting may cross it: the direction of those on this side of it alone.
vec3 licOwnSide(vec2 uv, vec3 tangent, int triangle) {
    ivec2 size = textureSize(licTones, 0);
    ivec2 texel = clamp(ivec2(vec2(uv.x, 1.0 - uv.y) * vec2(size)), ivec2(0), size - 1);
    // The nearest texel of this very triangle: at its edges the nearest one may speak of the neighbour's corners.
    const ivec2 around[9] = ivec2[](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1), ivec2(1, 1),
                                    ivec2(-1, 1), ivec2(1, -1), ivec2(-1, -1));
    int sides = 7;
    for (int i = 0; i < 9; ++i) {
        ivec2 beside = clamp(texel + around[i], ivec2(0), size - 1);
        int found = int(texelFetch(licTones, beside, 0).a * 255.0 + 0.5);
        if (found >> 3 != (triangle & 31)) continue;
        sides = found & 7;
        break;
    }
    if (sides == 7 || sides == 0) return tangent;
    vec2 a = licUvs[3 * triangle];
    vec2 b = licUvs[3 * triangle + 1] - a;
    vec2 c = licUvs[3 * triangle + 2] - a;
    vec2 d = uv - a;
    float area = b.x * c.y - b.y * c.x;
    float v = (d.x * c.y - d.y * c.x) / area;
    float w = (b.x * d.y - b.y * d.x) / area;
    float shares[3] = float[](1.0 - v - w, v, w);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        int at = 9 * triangle + 3 * k;
        // Never without any weight: texels are coarser than the line.
        if ((sides & (1 << k)) != 0)
            sum += max(shares[k], 0.01) * vec3(licTangents[at], licTangents[at + 1], licTangents[at + 2]);
    }
    return sum / max(length(sum), 1e-6);
}

// Everything of a pixel that needs its neighbours, so that it must be called for all of them.
LicHair licHair(vec2 uv, vec3 tangentIn, int triangle, vec3 n, vec3 toEye) {
    LicHair hair;
    vec4 texel = texture(licTones, vec2(uv.x, 1.0 - uv.y));
    vec3 own = texture(licColours, vec2(uv.x, 1.0 - uv.y)).rgb;
    hair.tone = texel.r * (255.0 / 127.0) - (128.0 / 127.0);
    hair.spread = max(texel.g - hair.tone * hair.tone, 0.0);
    if (dot(tangentIn, tangentIn) < 0.9) tangentIn = licOwnSide(uv, tangentIn, triangle);
    vec3 along = tangentIn - n * dot(n, tangentIn);
    float size = length(along);
    hair.tangent = size > 1e-4 ? along / size : vec3(0.0);
    vec3 halfway = normalize(scene.keyDirection.xyz + toEye);
    vec2 change = vec2(dFdx(dot(hair.tangent, halfway)), dFdy(dot(hair.tangent, halfway)));
    hair.grazing = min(dot(change, change) / 12.0, 0.25);
    // Where a parting crosses a triangle, what lies between two directions is none that any hair has.
    hair.agreed = smoothstep(0.5, 0.92, size);
    hair.cover = size > 1e-4 ? texel.b : 0.0;
    // Share of white: half of it is the hair's own colour; less is darker, more goes grey and white (licColour).
    float white = licTone.z;
    float grey = smoothstep(0.5, 1.0, white);
    hair.colour = mix(own * mix(0.22, 1.0, min(white * 2.0, 1.0)), vec3(0.62, 0.60, 0.57) + 0.2 * own, grey * grey);
    return hair;
}

// A lobe of the halo: hairs of the pixel see the light at angles spread around the mean by their tones, each the lighter
// the higher its tone. `along`: tangent and half vector; `shift`: of the mean hair; `scatter`: of a tone.
float licLobe(LicHair hair, float along, float shift, float scatter, float width, float contrast) {
    float own = width + hair.grazing;
    float all = own + scatter * scatter * hair.spread;
    float off = along + shift + scatter * hair.tone;
    // The tone of those hairs that shine here.
    float tone = hair.tone - off * scatter * hair.spread / all;
    return sqrt(width / all) * exp(-0.5 * off * off / all) * max(1.0 + contrast * tone, 0.0);
}

vec3 licHalo(LicHair hair, vec3 n, vec3 toEye, vec3 toLight, float contrast) {
    vec3 halfway = normalize(toLight + toEye + 1e-4 * n);
    float along = dot(hair.tangent, halfway);
    float facing = dot(n, halfway);
    float scatter = (0.035 + 0.5 * abs(licTone.y)) * facing;
    vec3 tinted = hair.colour / max(max(hair.colour.r, max(hair.colour.g, hair.colour.b)), 0.02);
    // As real strands have it: the surface of the hair, and what went through it, further out and broader.
    float first = licLobe(hair, along, -licTone.y * facing, scatter, licLight.w * 0.6, contrast);
    float second = licLobe(hair, along, 1.4 * licTone.y * facing, 1.5 * scatter, licLight.w * 2.5, contrast);
    vec3 colour = vec3(0.36) * first + tinted * (0.06 + 0.5 * sqrt(hair.colour)) * second;
    // Light and eye must be on this side of the head.
    float side = smoothstep(-0.05, 0.5, dot(n, toLight)) * smoothstep(-0.1, 0.35, dot(n, toEye)) * hair.agreed;
    // A broad shine spreads the same light further.
    return colour * (licLight.z * side / (1.0 + 6.0 * licLight.w));
}

// Light of a lamp that is scattered: across the hair most; light that falls across its grooves leaves dark hairs darker
// than light along them does.
float licDiffuse(LicHair hair, vec3 n, vec3 toLight, float contrast) {
    float along = dot(hair.tangent, toLight);
    float facing = dot(n, toLight);
    float across = sqrt(max(1.0 - along * along - facing * facing, 0.0));
    float wrapped = square(clamp((facing + 0.3) / 1.3, 0.0, 1.0));
    float depth = min(contrast * (0.8 + 0.45 * across), 1.0);
    float sine = mix(0.4, sqrt(max(1.0 - along * along, 0.0)), hair.agreed);
    return licLight.y * sine * wrapped * (1.0 + depth * hair.tone);
}

// `arrives`: shares of the key light and of the surroundings that come to the place. VERTEX_LIT: halo of the key light
// only.
vec3 licShade(LicHair hair, vec3 n, vec3 toEye, vec2 arrives) {
    float key = arrives.x;
    float contrast = licTone.x;
    vec3 lit = scene.keyColour.rgb * key * hair.colour * licDiffuse(hair, n, scene.keyDirection.xyz, contrast);
    lit += scene.keyColour.rgb * key * licHalo(hair, n, toEye, scene.keyDirection.xyz, contrast);
    lit += scene.fillColour.rgb * arrives.y * hair.colour * licDiffuse(hair, n, scene.fillDirection.xyz, contrast);
    vec3 rim = hair.colour * licDiffuse(hair, n, scene.rimDirection.xyz, contrast);
#ifndef VERTEX_LIT
    rim += 0.5 * licHalo(hair, n, toEye, scene.rimDirection.xyz, contrast);
#endif
    lit += scene.rimColour.rgb * square(arrives.y) * rim;
    lit += hemisphere(n) * licLight.x * arrives.y * hair.colour * (1.0 + 0.8 * contrast * hair.tone);
    return lit;
}
