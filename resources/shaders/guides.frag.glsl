// SPDX-License-Identifier: Apache-2.0
// Guides: bright, dark-rimmed, so that they read on skin and on hair.
layout(location = 0) in vec3 across;
layout(location = 1) in float along;
layout(location = 0) out vec4 colour;
uniform vec3 rootColour;
uniform vec3 tipColour;
void main() {
    float distance = length(across.xy);
    float share = clamp(across.z + 0.5 - distance, 0.0, 1.0);
    float rim = clamp(across.z + 1.0 - distance, 0.0, 1.0) * 0.45;
    float opacity = share + rim * (1.0 - share);
    colour = vec4(mix(rootColour, tipColour, along) * share / max(opacity, 1e-3), opacity);
}
