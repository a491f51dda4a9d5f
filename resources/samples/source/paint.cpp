// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/paint.h"

#include <algorithm>
#include <cmath>

namespace whorl::samples {

using glm::vec2;
using glm::vec3;

namespace {

constexpr float kTolerance = -1e-4f;

/// Calls visit(texel, point) for each texel centre covered by a chart.
template <typename Visit>
void eachTexel(const Sculpture& sculpture, int size, Visit&& visit) {
    for (size_t part = 0; part < sculpture.parts.size(); ++part) {
        for (const auto& t : sculpture.parts[part].triangles) {
            std::array<vec2, 3> p;
            for (int c = 0; c < 3; ++c) {
                const vec2 uv = sculpture.uvs[t[c]];
                p[c] = vec2(uv.x, 1.0f - uv.y) * float(size) - 0.5f;
            }
            const vec2 u = p[1] - p[0], v = p[2] - p[0];
            const float area = u.x * v.y - u.y * v.x;
            if (area == 0.0f) {
                continue;
            }
            const vec2 lo = glm::min(p[0], glm::min(p[1], p[2])), hi = glm::max(p[0], glm::max(p[1], p[2]));
            const int x0 = std::max(int(std::floor(lo.x)), 0), x1 = std::min(int(std::ceil(hi.x)), size - 1);
            const int y0 = std::max(int(std::floor(lo.y)), 0), y1 = std::min(int(std::ceil(hi.y)), size - 1);
            for (int y = y0; y <= y1; ++y) {
                for (int x = x0; x <= x1; ++x) {
                    const vec2 d = vec2(x, y) - p[0];
                    const float b = (d.x * v.y - d.y * v.x) / area;
                    const float c = (u.x * d.y - u.y * d.x) / area;
                    const float a = 1.0f - b - c;
                    if (a < kTolerance || b < kTolerance || c < kTolerance) {
                        continue;
                    }
                    auto mix = [&](const std::vector<vec3>& from) {
                        return a * from[t[0]] + b * from[t[1]] + c * from[t[2]];
                    };
                    visit(size_t(y) * size_t(size) + size_t(x),
                          PaintPoint{mix(sculpture.positions), glm::normalize(mix(sculpture.normals)), int(part)});
                }
            }
        }
    }
}

/// Fills uncovered texels from their covered neighbours, ring by ring.
template <typename T>
void dilate(std::vector<T>& values, std::vector<char>& covered, int size, int rings) {
    std::vector<char> next = covered;
    for (int ring = 0; ring < rings; ++ring) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const size_t at = size_t(y) * size_t(size) + size_t(x);
                if (covered[at]) {
                    continue;
                }
                T sum(0.0f);
                float count = 0.0f;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int nx = x + dx, ny = y + dy;
                        if (nx >= 0 && ny >= 0 && nx < size && ny < size) {
                            const size_t from = size_t(ny) * size_t(size) + size_t(nx);
                            if (covered[from]) {
                                sum += values[from];
                                count += 1.0f;
                            }
                        }
                    }
                }
                if (count > 0.0f) {
                    values[at] = sum / count;
                    next[at] = 1;
                }
            }
        }
        covered = next;
    }
}

template <typename Image, typename T, typename Painter>
Image paint(const Sculpture& sculpture, int size, const Painter& painter) {
    Image image;
    image.width = image.height = size;
    image.values.assign(size_t(size) * size_t(size), T(0.0f));
    std::vector<char> covered(image.values.size(), 0);
    eachTexel(sculpture, size, [&](size_t texel, const PaintPoint& point) {
        if (!covered[texel]) {
            image.values[texel] = painter(point);
            covered[texel] = 1;
        }
    });
    constexpr int kRings = 12;
    dilate(image.values, covered, size, kRings);
    return image;
}

float lattice(int x, int y, int z) {
    uint32_t h = uint32_t(x) * 0x8da6b343u ^ uint32_t(y) * 0xd8163841u ^ uint32_t(z) * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return float((h ^ h >> 15) & 0xffff) / 32767.5f - 1.0f;
}

}  // namespace

ScalarImage paintScalar(const Sculpture& sculpture, int size, const std::function<float(const PaintPoint&)>& painter) {
    return paint<ScalarImage, float>(sculpture, size,
                                     [&](const PaintPoint& p) { return std::clamp(painter(p), 0.0f, 1.0f); });
}

ColourImage paintColour(const Sculpture& sculpture, int size, const std::function<vec3(const PaintPoint&)>& painter) {
    return paint<ColourImage, vec3>(sculpture, size, painter);
}

float paintNoise(const vec3& p) {
    const vec3 cell = glm::floor(p);
    const vec3 f = p - cell;
    const vec3 s = f * f * (3.0f - 2.0f * f);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
        sum += lattice(int(cell.x) + dx, int(cell.y) + dy, int(cell.z) + dz) * (dx ? s.x : 1.0f - s.x) *
               (dy ? s.y : 1.0f - s.y) * (dz ? s.z : 1.0f - s.z);
    }
    return sum;
}

}  // namespace whorl::samples
