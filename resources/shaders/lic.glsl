// SPDX-License-Identifier: Apache-2.0
// Hair texture over the skin, lit from the direction of the hair (seed 002, sections 3.1 and 4). Needs skin.glsl.
//
// A pixel that holds many hairs shows their mean without any being drawn: brightness is linear in the tone of a hair,
// and the halo is a bell whose mean over tones of that variance is known.
layout(binding = 6) uniform sampler2D licTones;    // tone (128/255 is 0), its square, cover
layout(binding = 7) uniform sampler2D licColours;
uniform vec4 licLight;  // ambient, diffuse, highlight, 1 / shininess
uniform vec4 licTone;   // contrast, shift of the halo, mean of the convolution

struct LicHair {
    vec3 tangent;
    vec3 colour;   // of the mean hair
    float tone;    // mean of the pixel's hairs, -1 dark to 1 light
    float spread;  // their variance
    float grazing; // variance of the angle to the halo over the pixel
    float cover;
};

float square(float x) { return x * x; }

// Everything of a pixel that needs its neighbours, so that it must be called for all of them.
LicHair licHair(vec2 uv, vec3 tangentIn, vec3 n, vec3 position, vec3 toEye) {
    LicHair hair;
    vec4 texel = texture(licTones, vec2(uv.x, 1.0 - uv.y));
    vec3 own = texture(licColours, vec2(uv.x, 1.0 - uv.y)).rgb;
    hair.tone = texel.r * (255.0 / 127.0) - (128.0 / 127.0);
    hair.spread = max(texel.g - hair.tone * hair.tone, 0.0);
    vec3 along = tangentIn - n * dot(n, tangentIn);
    float size = length(along);
    hair.tangent = size > 1e-4 ? along / size : vec3(0.0);
    vec3 halfway = normalize(scene.keyDirection.xyz + toEye);
    vec2 change = vec2(dFdx(dot(hair.tangent, halfway)), dFdy(dot(hair.tangent, halfway)));
    // Directions that differ between a triangle's corners spread the halo, too: at partings and whorls.
    hair.grazing = min(dot(change, change) / 12.0, 0.25) + 0.25 * square(1.0 - min(size, 1.0));
    hair.cover = size > 1e-4 ? texel.b : 0.0;
    // Share of white: half of it is the hair's own colour; less is darker, more goes grey and white.
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
    float first = licLobe(hair, along, -licTone.y * facing, scatter, licLight.w, contrast);
    float second = licLobe(hair, along, 1.4 * licTone.y * facing, 1.5 * scatter, licLight.w * 3.0, contrast);
    vec3 colour = vec3(0.42) * first + tinted * (0.06 + 0.5 * sqrt(hair.colour)) * second;
    // Light and eye must be on this side of the head.
    float side = smoothstep(-0.05, 0.5, dot(n, toLight)) * smoothstep(-0.1, 0.35, dot(n, toEye));
    return colour * (licLight.z * side);
}

// Light of a lamp that is scattered: across the hair most; light that falls across its grooves leaves dark hairs darker
// than light along them does.
float licDiffuse(LicHair hair, vec3 n, vec3 toLight, float contrast) {
    float along = dot(hair.tangent, toLight);
    float facing = dot(n, toLight);
    float across = sqrt(max(1.0 - along * along - facing * facing, 0.0));
    float wrapped = square(clamp((facing + 0.3) / 1.3, 0.0, 1.0));
    float depth = min(contrast * (0.8 + 0.45 * across), 1.0);
    return licLight.y * sqrt(max(1.0 - along * along, 0.0)) * wrapped * (1.0 + depth * hair.tone);
}

vec3 licShade(LicHair hair, vec3 position, vec3 n, vec3 toEye) {
    vec4 ambient = ambientLight(position + n * 0.004);
    float key = meshLight(position, n) * hairLight(position + n * 0.001);
    float contrast = licTone.x;
    vec3 lit = scene.keyColour.rgb * key * hair.colour * licDiffuse(hair, n, scene.keyDirection.xyz, contrast);
    lit += scene.keyColour.rgb * key * licHalo(hair, n, toEye, scene.keyDirection.xyz, contrast);
    lit += scene.fillColour.rgb * ambient.w * hair.colour * licDiffuse(hair, n, scene.fillDirection.xyz, contrast);
    lit += scene.rimColour.rgb * square(ambient.w) * (hair.colour * licDiffuse(hair, n, scene.rimDirection.xyz, contrast) +
                                                      licHalo(hair, n, toEye, scene.rimDirection.xyz, contrast));
    lit += hemisphere(n) * licLight.x * ambient.w * hair.colour * (1.0 + 0.8 * contrast * hair.tone);
    return lit;
}
