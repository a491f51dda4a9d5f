// SPDX-License-Identifier: Apache-2.0
// Skin under studio lights: what multiplies its colour, and what lies over it.
#include "scene.glsl"
#include "lighting.glsl"

// Shares of the key light and of the surroundings that come to a place just outside the skin.
vec2 lightArriving(vec3 position, vec3 n) {
    return vec2(meshLight(position, n) * hairLight(position + n * 0.001), ambientLight(position + n * 0.004).w);
}

void skinLight(vec3 position, vec3 n, vec3 toEye, out vec3 light, out vec3 gloss) {
    vec4 ambient = ambientLight(position + n * 0.004);
    // Light that falls through hair reddens and spreads; skin below stays visible.
    float key = meshLight(position, n) * hairLight(position + n * 0.001);
    // Skin scatters: the shadow edge is soft and warm.
    float facing = dot(n, scene.keyDirection.xyz);
    vec3 wrap = vec3(0.34, 0.22, 0.18);
    vec3 diffuse = clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0);
    diffuse *= diffuse;
    light = scene.keyColour.rgb * key * diffuse;
    light += scene.fillColour.rgb * ambient.w * clamp(dot(n, scene.fillDirection.xyz) * 0.6 + 0.4, 0.0, 1.0);
    light += scene.rimColour.rgb * ambient.w * clamp(dot(n, scene.rimDirection.xyz), 0.0, 1.0);
    light += hemisphere(n) * scene.hair.w * ambient.w;
    // White plaster stays below white.
    light *= 0.56;
    // A broad, weak sheen, stronger at grazing angles.
    vec3 halfway = normalize(scene.keyDirection.xyz + toEye);
    float fresnel = 0.035 + 0.5 * pow(1.0 - clamp(dot(n, toEye), 0.0, 1.0), 5.0);
    float sheen = pow(clamp(dot(n, halfway), 0.0, 1.0), 22.0) * 1.6 * key * clamp(facing * 4.0, 0.0, 1.0);
    gloss = scene.keyColour.rgb * sheen * fresnel;
    gloss += hemisphere(reflect(-toEye, n)) * fresnel * 0.35 * ambient.w * ambient.w;
}
