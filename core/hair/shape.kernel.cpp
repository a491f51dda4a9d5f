// SPDX-License-Identifier: Apache-2.0
#include "core/hair/shape.kernel.h"

#include "core/base/lanes.h"
#include "core/base/noise.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = HairLanes::lanes;

using lanes16::Lanes;

// Adds one guide's points, turned and weighted.
inline void addGuide(const float* matrix, const float* gx, const float* gy, const float* gz, Lanes& x, Lanes& y,
                     Lanes& z) {
    Lanes px, py, pz;
    lanes16::load(gx, px);
    lanes16::load(gy, py);
    lanes16::load(gz, pz);
    x += matrix[0] * px + matrix[lanes] * py + matrix[2 * lanes] * pz;
    y += matrix[3 * lanes] * px + matrix[4 * lanes] * py + matrix[5 * lanes] * pz;
    z += matrix[6 * lanes] * px + matrix[7 * lanes] * py + matrix[8 * lanes] * pz;
}

// Noise at the places of sixteen vertices, weighted: adds to the three pushes.
inline void addKink(const float* x, const float* y, const float* z, const float* amount, float* pushX, float* pushY,
                    float* pushZ) {
    for (std::size_t v = 0; v < lanes; ++v) {
        float noise[3];
        perlinVector(x[v], y[v], z[v], noise);
        pushX[v] += amount[v] * noise[0];
        pushY[v] += amount[v] * noise[1];
        pushZ[v] += amount[v] * noise[2];
    }
}

}  // namespace

void turnGuides(const TurnArrays& t) {
    const HairLanes& h = *t.hairs;
    float fx[lanes], fy[lanes], fz[lanes], out[9][lanes], cosines[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        const float* from = t.guideNormals + std::size_t{3} * t.guides[l];
        fx[l] = from[0];
        fy[l] = from[1];
        fz[l] = from[2];
    }
    for (std::size_t l = 0; l < lanes; ++l) {
        const float tx = h.normalX[l], ty = h.normalY[l], tz = h.normalZ[l];
        const float wx = fy[l] * tz - fz[l] * ty, wy = fz[l] * tx - fx[l] * tz, wz = fx[l] * ty - fy[l] * tx;
        const float cosine = fx[l] * tx + fy[l] * ty + fz[l] * tz;
        const float k = 1.0f / (1.0f + cosine);
        const float weight = t.weights[l];
        const float kx = k * wx, ky = k * wy;
        out[0][l] = weight * (cosine + kx * wx);
        out[1][l] = weight * (kx * wy - wz);
        out[2][l] = weight * (kx * wz + wy);
        out[3][l] = weight * (kx * wy + wz);
        out[4][l] = weight * (cosine + ky * wy);
        out[5][l] = weight * (ky * wz - wx);
        out[6][l] = weight * (kx * wz - wy);
        out[7][l] = weight * (ky * wz + wx);
        out[8][l] = weight * (cosine + k * wz * wz);
        cosines[l] = cosine;
    }
    __builtin_memcpy(t.matrix, out, sizeof out);
    __builtin_memcpy(t.cosine, cosines, sizeof cosines);
}

void shapeHairs(const ShapeArrays& a) {
    const HairLanes& h = *a.hairs;
    for (std::size_t hair = 0; hair < a.count; ++hair) {
        const float scale = h.scale[hair];
        const float rootX = h.rootX[hair], rootY = h.rootY[hair], rootZ = h.rootZ[hair];
        const float frizzX = h.frizz[0][hair], frizzY = h.frizz[1][hair], frizzZ = h.frizz[2][hair];
        const float frizzRoot = h.frizzRoot[hair], frizzSpan = h.frizzTip[hair] - frizzRoot;
        const float kinkRoot = h.kinkRoot[hair], kinkSpan = h.kinkTip[hair] - kinkRoot;
        const float kx = h.kinkFrequency[0][hair], ky = h.kinkFrequency[1][hair], kz = h.kinkFrequency[2][hair];
        const bool kinked = kinkRoot > 0.0f || h.kinkTip[hair] > 0.0f;
        const std::size_t guides = a.counts[hair];
        for (std::size_t start = 0; start < a.stride; start += lanes) {
            Lanes x = {}, y = {}, z = {}, along, ease;
            for (std::size_t j = 0; j < guides; ++j) {
                const std::size_t from = a.starts[j * lanes + hair] + start;
                addGuide(a.matrices + j * 9 * lanes + hair, a.guideX + from, a.guideY + from, a.guideZ + from, x, y, z);
            }
            lanes16::load(a.along + start, along);
            lanes16::load(a.ease + start, ease);
            x = rootX + scale * x;
            y = rootY + scale * y;
            z = rootZ + scale * z;
            const Lanes frizz = ease * (frizzRoot + frizzSpan * along);
            Lanes pushX = frizz * frizzX, pushY = frizz * frizzY, pushZ = frizz * frizzZ;
            if (kinked) {
                float places[3][lanes], push[3][lanes], amount[lanes];
                lanes16::store(x * kx + a.kinkOffset[0], places[0]);
                lanes16::store(y * ky + a.kinkOffset[1], places[1]);
                lanes16::store(z * kz + a.kinkOffset[2], places[2]);
                lanes16::store(ease * (kinkRoot + kinkSpan * along), amount);
                lanes16::store(pushX, push[0]);
                lanes16::store(pushY, push[1]);
                lanes16::store(pushZ, push[2]);
                addKink(places[0], places[1], places[2], amount, push[0], push[1], push[2]);
                lanes16::load(push[0], pushX);
                lanes16::load(push[1], pushY);
                lanes16::load(push[2], pushZ);
            }
            const std::size_t to = hair * a.stride + start;
            lanes16::store(x + pushX, a.x + to);
            lanes16::store(y + pushY, a.y + to);
            lanes16::store(z + pushZ, a.z + to);
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
