// SPDX-License-Identifier: Apache-2.0
// Guides: dark-rimmed, so that they read on skin and on hair; thin and transparent, so that both show through.
layout(location = 0) in vec3 across;
layout(location = 1) in float along;
layout(location = 2) in float opacity;
layout(location = 0) out vec4 colour;
uniform vec3 rootColour;
uniform vec3 tipColour;
void main() {
    float distance = length(across.xy);
    float share = clamp(across.z + 0.5 - distance, 0.0, 1.0);
    float rim = clamp(across.z + 1.0 - distance, 0.0, 1.0) * 0.35;
    float cover = share + rim * (1.0 - share);
    colour = vec4(mix(rootColour, tipColour, along) * share / max(cover, 1e-3), cover * opacity);
}
