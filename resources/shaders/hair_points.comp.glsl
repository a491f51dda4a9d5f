// SPDX-License-Identifier: Apache-2.0
// Every hair at `pointsPerHair` even places of its Catmull-Rom curve: projected, and lit by Kajiya-Kay.
// Once a point: the two corners of the ribbon there, ready for the rasteriser. POINTS: the point itself on the picture,
// for ribbons that the processor draws. QUICK: highlights of the key light only.
layout(local_size_x = 64) in;
#include "scene.glsl"
#include "lighting.glsl"
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Widths { float widths[]; };
layout(std430, binding = 2) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 3) readonly buffer First { uint firstVertex[]; };
layout(std430, binding = 4) readonly buffer Roots { vec4 roots[]; };  // normal of the skin, random number
#ifdef POINTS
struct Point {
    vec4 place;  // pixels from the bottom left, depth, half width or less than 0
    vec4 colour;
};
layout(std430, binding = 6) writeonly buffer Points { Point points[]; };
#else
struct Vertex {
    vec4 clip;
    uvec2 colour;  // four halves
    vec2 across;   // pixels from the middle, half width
};
layout(std430, binding = 6) writeonly buffer Vertices { Vertex vertices[]; };  // left and right of each point
#endif
uniform uint hairCount;      // drawn
uniform uint stride;         // every stride-th hair is drawn
uniform uint pointsPerHair;
uniform float widthScale;    // for the hairs left out

vec3 vertexAt(uint i) { return vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]); }
float sine(float cosine) { return sqrt(max(1.0 - cosine * cosine, 0.0)); }

// Light of one lamp, reflected: diffuse sin(t, l); two lobes sin(t, h)^p along shifted tangents (seed 004, section 2.2;
// shifts as in Scheuermann 2004). The primary lobe keeps the lamp's colour, the secondary went through the hair.
vec3 strandLight(vec3 tangent, vec3 normal, vec3 toEye, vec3 toLight, vec3 albedo, float random, float wrapped) {
    float along = dot(tangent, toLight);
    vec3 halfway = normalize(toLight + toEye + 1e-4 * normal);
    float jitter = (random - 0.5) * 0.16;
    float first = sine(dot(normalize(tangent + normal * (jitter - 0.07)), halfway));
    float second = sine(dot(normalize(tangent + normal * (jitter + 0.17)), halfway));
    float p = scene.hair.z;
    float glints = 0.55 + 0.9 * fract(random * 57.31);
    vec3 tinted = albedo / max(max(albedo.r, max(albedo.g, albedo.b)), 0.02);
    vec3 specular = vec3(0.34) * pow(first, p * 1.7) * (0.6 + 0.8 * fract(random * 91.7));
    specular += tinted * (0.08 + 0.72 * sqrt(albedo)) * pow(second, p * 0.4) * glints;
    vec3 diffuse = albedo * scene.hair.x * sine(along);
    // Highlights need light and eye on this side of the head.
    float side = smoothstep(-0.15, 0.55, dot(normal, toLight)) * smoothstep(-0.4, 0.4, dot(normal, toEye));
    return diffuse * wrapped + specular * scene.hair.y * side;
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    uint hair = index / pointsPerHair;
    if (hair >= hairCount) return;
    uint stepIndex = index - hair * pointsPerHair;
    hair *= stride;
    uint first = firstVertex[hair];
    uint last = firstVertex[hair + 1u] - 1u;
    float share = float(stepIndex) / float(pointsPerHair - 1u);
    float place = share * float(last - first);
    uint low = min(first + uint(place), max(last, first + 1u) - 1u);
    float t = place - float(low - first);
    uint next = min(low + 1u, last);
    vec3 b = vertexAt(low);
    vec3 c = vertexAt(next);
    // The curve passes through its ends: beyond them the end segments are mirrored.
    vec3 a = low > first ? vertexAt(low - 1u) : 2.0 * b - c;
    vec3 d = next < last ? vertexAt(next + 1u) : 2.0 * c - b;
    vec3 m0 = 0.5 * (c - a);
    vec3 m1 = 0.5 * (d - b);
    vec3 e = c - b;
    vec3 position = b + t * (m0 + t * ((3.0 * e - 2.0 * m0 - m1) + t * (m0 + m1 - 2.0 * e)));
    vec3 slope = m0 + t * (2.0 * (3.0 * e - 2.0 * m0 - m1) + t * 3.0 * (m0 + m1 - 2.0 * e));
    float slopeLength = length(slope);
    vec3 tangent = slopeLength > 1e-9 ? slope / slopeLength : vec3(0.0, 1.0, 0.0);
    vec4 own = mix(colours[low], colours[next], t);
    float width = mix(widths[low], widths[next], t) * widthScale;
    vec4 root = roots[hair];

    vec4 clip = scene.clipFromGroom * vec4(position, 1.0);
    vec4 ahead = scene.clipFromGroom * vec4(tangent, 0.0);
    vec2 direction = (ahead.xy * clip.w - clip.xy * ahead.w) * scene.viewport.xy;
    float directionLength = length(direction);
    vec2 across = directionLength > 1e-12 ? vec2(-direction.y, direction.x) / directionLength : vec2(1.0, 0.0);
    float pixels = width * scene.pixel.x / max(clip.w, 1e-6);
    // Thinner than the limit: as wide as the limit, and as much more transparent.
    float opacity = own.a * min(pixels / scene.pixel.y, 1.0);
    // Behind the eye, or not a curve: out of the picture.
    if (clip.w < 1e-4 || last <= first) {
        clip = vec4(2.0, 2.0, 2.0, 1.0);
        opacity = 0.0;
    }

    vec3 toEye = normalize(scene.eye.xyz - position);
    vec4 ambient = ambientLight(position);
    // Outward: the skin's normal at the root, further out where the light comes from.
    vec3 outward = normalize(mix(root.xyz, ambient.xyz, smoothstep(0.0, 0.8, share) * 0.65) + root.xyz * 0.15 + 1e-4);
    vec3 normal = normalize(outward - tangent * dot(outward, tangent) + 1e-4 * toEye);
    float visible = ambient.w;
    float through = hairLight(position) * meshLight(position, root.xyz);
    // What passes through hair takes its colour: red goes deepest.
    vec3 keyLight = scene.keyColour.rgb * pow(vec3(through), vec3(0.86, 1.0, 1.12));
    vec3 albedo = own.rgb * (0.82 + 0.36 * root.w);
    float wrapKey = clamp((dot(outward, scene.keyDirection.xyz) + 0.45) / 1.45, 0.0, 1.0);
    float wrapFill = clamp(dot(outward, scene.fillDirection.xyz) * 0.6 + 0.4, 0.0, 1.0);
    float wrapRim = clamp((dot(outward, scene.rimDirection.xyz) + 0.3) / 1.3, 0.0, 1.0);
    vec3 lit = keyLight * strandLight(tangent, normal, toEye, scene.keyDirection.xyz, albedo, root.w, wrapKey);
#ifdef QUICK
    vec3 others = scene.fillColour.rgb * wrapFill + scene.rimColour.rgb * (visible * wrapRim * 1.3);
    lit += others * albedo * (visible * scene.hair.x);
#else
    lit += scene.fillColour.rgb * visible * strandLight(tangent, normal, toEye, scene.fillDirection.xyz, albedo, root.w, wrapFill);
    lit += scene.rimColour.rgb * visible * visible * strandLight(tangent, normal, toEye, scene.rimDirection.xyz, albedo, root.w, wrapRim);
#endif
    lit += hemisphere(outward) * scene.hair.w * albedo * visible;

    float halfWidth = max(pixels, scene.pixel.y) * 0.5;
#ifdef POINTS
    vec3 onPicture = clip.xyz / max(clip.w, 1e-6) * 0.5 + 0.5;
    points[index] = Point(vec4(onPicture.xy * scene.viewport.xy, onPicture.z, opacity > 0.0 ? halfWidth : -1.0), vec4(lit, opacity));
#else
    float reach = halfWidth + scene.pixel.z;
    vec4 offset = vec4(across * (reach * 2.0 * clip.w) * scene.viewport.zw, 0.0, 0.0);
    uvec2 colour = uvec2(packHalf2x16(lit.rg), packHalf2x16(vec2(lit.b, opacity)));
    vertices[2u * index] = Vertex(clip - offset, colour, vec2(-reach, halfWidth));
    vertices[2u * index + 1u] = Vertex(clip + offset, colour, vec2(reach, halfWidth));
#endif
}
