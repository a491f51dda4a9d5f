// SPDX-License-Identifier: Apache-2.0
// How much of each light arrives at a place.
layout(binding = 0) uniform sampler3D voxelSum;
layout(binding = 1) uniform sampler3D ambientVolume;
layout(binding = 2) uniform sampler2DShadow shadowMap;

// Layers of hair between the key light and p, summed along the light (seed 004, section 2.3.1: light = alpha^sum).
float hairLight(vec3 p) {
    vec3 place = (scene.voxelFromGroom * vec4(p, 1.0)).xyz;
    return exp2(scene.shadow.x * textureLod(voxelSum, place, 0.0).r);
}

// Percentage-closer filtering of the mesh's shadow map.
float meshLight(vec3 p, vec3 normal) {
    vec3 place = (scene.shadowFromGroom * vec4(p + normal * scene.shadow.z, 1.0)).xyz;
    if (scene.shadow.w < 2.0) return textureLod(shadowMap, place, 0.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += textureLod(shadowMap, place + vec3(vec2(x, y) * 1.5 * scene.shadow.y, 0.0), 0.0);
        }
    }
    return sum / 9.0;
}

// xyz: where the light comes from on the whole; w: share of the surroundings that is not hidden by hair.
vec4 ambientLight(vec3 p) {
    vec3 place = p * scene.ambientScale.xyz + scene.ambientOffset.xyz;
    if (any(lessThan(place, vec3(0.0))) || any(greaterThan(place, vec3(1.0)))) return vec4(0.0, 0.0, 0.0, 1.0);
    return textureLod(ambientVolume, place, 0.0);
}

vec3 hemisphere(vec3 normal) { return mix(scene.groundColour.rgb, scene.skyColour.rgb, normal.y * 0.5 + 0.5); }
