// SPDX-License-Identifier: Apache-2.0
layout(location = 0) out vec4 colour;
void main() { colour = vec4(0.3, 0.16, 0.08, 1.0); }
