// SPDX-License-Identifier: Apache-2.0
// What all passes know of the picture; filled by render/passes/scene_block.h. All positions are in the groom's space.
layout(std140, binding = 0) uniform Scene {
    mat4 clipFromGroom;
    mat4 shadowFromGroom;  // to the texels and depth of the mesh's shadow map, 0 to 1
    mat4 voxelFromGroom;   // to the light-space volume of hair, 0 to 1
    vec4 ambientScale;     // to the volume of ambient light: position * scale + offset
    vec4 ambientOffset;
    vec4 eye;
    vec4 keyDirection;     // towards the light
    vec4 keyColour;
    vec4 fillDirection;
    vec4 fillColour;
    vec4 rimDirection;
    vec4 rimColour;
    vec4 skyColour;
    vec4 groundColour;
    vec4 viewport;         // pixels, 1 / pixels
    vec4 hair;             // diffuse, specular, shininess, ambient
    vec4 shadow;           // log2(light through one layer) * layers of a full texel, texel of the map, bias in metres, taps
    vec4 pixel;            // pixels of one metre at distance one, smallest hair width, fringe, unused
} scene;
