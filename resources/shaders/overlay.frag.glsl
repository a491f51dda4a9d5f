// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 result;
layout(binding = 0) uniform sampler2D font;
void main() { result = colour * texture(font, uv); }
