// SPDX-License-Identifier: Apache-2.0
// Corners of triangles, pulled from the welded mesh: three vertices a triangle. SHADOW: places only, seen by the light.
// LIC: with hair texture.
#include "scene.glsl"
#ifdef VERTEX_LIT
#include "skin.glsl"
#endif
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Normals { float normals[]; };
layout(std430, binding = 2) readonly buffer Triangles { uint corners[]; };
layout(std430, binding = 3) readonly buffer Uvs { vec2 uvs[]; };
#ifdef VERTEX_LIT
layout(location = 0) out vec3 light;
layout(location = 1) out vec3 gloss;
#else
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
#endif
layout(location = 2) out vec2 uv;
layout(location = 3) flat out vec4 triangleColour;
#ifdef LIC
layout(std430, binding = 5) readonly buffer LicUvs { vec2 licUvs[]; };
layout(std430, binding = 6) readonly buffer LicTangents { float licTangents[]; };
layout(location = 4) out vec3 tangent;
layout(location = 5) out vec2 licUv;
layout(location = 9) flat out int licTriangle;
#ifdef VERTEX_LIT
layout(location = 6) out vec3 position;
layout(location = 7) out vec3 normal;
layout(location = 8) out vec2 arrives;
#endif
#endif
layout(std430, binding = 4) readonly buffer Colours { vec4 triangleColours[]; };
uniform int coloured;  // triangles have colours

vec3 at(uint i) { return vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]); }

void main() {
    uint vertex = corners[gl_VertexID];
#if defined(VERTEX_LIT) && !defined(LIC)
    vec3 position = at(vertex);
    vec3 normal;
#else
    position = at(vertex);
#endif
#ifdef SHADOW
    gl_Position = scene.shadowFromGroom * vec4(position, 1.0);
    gl_Position.xyz = gl_Position.xyz * 2.0 - 1.0;
#else
    normal = vec3(normals[3u * vertex], normals[3u * vertex + 1u], normals[3u * vertex + 2u]);
#ifdef VERTEX_LIT
    skinLight(position, normal, normalize(scene.eye.xyz - position), light, gloss);
#ifdef LIC
    arrives = lightArriving(position, normal);
#endif
#endif
    uv = uvs[gl_VertexID];
#ifdef LIC
    licUv = licUvs[gl_VertexID];
    licTriangle = gl_VertexID / 3;
    tangent = vec3(licTangents[3 * gl_VertexID], licTangents[3 * gl_VertexID + 1], licTangents[3 * gl_VertexID + 2]);
#endif
    triangleColour = coloured != 0 ? triangleColours[gl_VertexID / 3] : vec4(0.0);
    gl_Position = scene.clipFromGroom * vec4(position, 1.0);
#endif
}
