// SPDX-License-Identifier: Apache-2.0
#include "core/hair/shape.kernel.h"

#include "core/base/noise.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr int lanes = 16;

// Adds one guide's points, turned and weighted.
inline void addGuide(const float* matrix, const float* gx, const float* gy, const float* gz, float* x, float* y,
                     float* z) {
    for (int v = 0; v < lanes; ++v) {
        x[v] += matrix[0] * gx[v] + matrix[1] * gy[v] + matrix[2] * gz[v];
        y[v] += matrix[3] * gx[v] + matrix[4] * gy[v] + matrix[5] * gz[v];
        z[v] += matrix[6] * gx[v] + matrix[7] * gy[v] + matrix[8] * gz[v];
    }
}

}  // namespace

void shapeHairs(const ShapeArrays& a, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        const std::size_t hair = a.hairs[i];
        const HairTraits& t = a.traits[hair];
        const float scale = t.scale;
        const float rootX = a.roots[i * 3], rootY = a.roots[i * 3 + 1], rootZ = a.roots[i * 3 + 2];
        const float frizzX = t.frizz[0], frizzY = t.frizz[1], frizzZ = t.frizz[2];
        const float frizzRoot = t.frizzRoot, frizzSpan = t.frizzTip - t.frizzRoot;
        const float kinkRoot = t.kinkRoot, kinkSpan = t.kinkTip - t.kinkRoot;
        const float kx = t.kinkFrequency[0], ky = t.kinkFrequency[1], kz = t.kinkFrequency[2];
        const float ox = a.kinkOffset[0], oy = a.kinkOffset[1], oz = a.kinkOffset[2];
        const bool kinked = t.kinkRoot > 0.0f || t.kinkTip > 0.0f;
        const std::size_t guides = a.counts[hair];
        for (std::size_t start = 0; start < a.stride; start += lanes) {
            float x[lanes] = {}, y[lanes] = {}, z[lanes] = {};
            for (std::size_t j = 0; j < guides; ++j) {
                const std::size_t place = hair * a.perHair + j;
                const std::size_t from = a.firstOfGuide[a.guides[place]] + start;
                addGuide(a.matrices + place * 9, a.guideX + from, a.guideY + from, a.guideZ + from, x, y, z);
            }
            const float* along = a.along + start;
            const float* ease = a.ease + start;
            for (int v = 0; v < lanes; ++v) {
                x[v] = rootX + scale * x[v];
                y[v] = rootY + scale * y[v];
                z[v] = rootZ + scale * z[v];
            }
            float pushX[lanes], pushY[lanes], pushZ[lanes];
            for (int v = 0; v < lanes; ++v) {
                const float amount = ease[v] * (frizzRoot + frizzSpan * along[v]);
                pushX[v] = amount * frizzX;
                pushY[v] = amount * frizzY;
                pushZ[v] = amount * frizzZ;
            }
            if (kinked) {
                for (int v = 0; v < lanes; ++v) {
                    float noise[3];
                    perlinVector(x[v] * kx + ox, y[v] * ky + oy, z[v] * kz + oz, noise);
                    const float amount = ease[v] * (kinkRoot + kinkSpan * along[v]);
                    pushX[v] += amount * noise[0];
                    pushY[v] += amount * noise[1];
                    pushZ[v] += amount * noise[2];
                }
            }
            const std::size_t to = i * a.stride + start;
            for (int v = 0; v < lanes; ++v) {
                a.x[to + static_cast<std::size_t>(v)] = x[v] + pushX[v];
                a.y[to + static_cast<std::size_t>(v)] = y[v] + pushY[v];
                a.z[to + static_cast<std::size_t>(v)] = z[v] + pushZ[v];
            }
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
