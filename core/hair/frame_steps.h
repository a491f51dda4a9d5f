// SPDX-License-Identifier: Apache-2.0
// Steps of double reflection, sixteen hairs in lanes. Internal linkage and plain arithmetic only (see
// core/base/simd.h).
#pragma once

namespace whorl::frame_steps {

static constexpr int lanes = 16;
static constexpr float tiny = 1e-24f;

struct Vectors {
    float x[lanes], y[lanes], z[lanes];
};

// Unit directions from one row of points to another; where both are the same, `t` stays.
static inline void tangents(const float* fromX, const float* fromY, const float* fromZ, const float* toX,
                            const float* toY, const float* toZ, Vectors& t) {
    for (int l = 0; l < lanes; ++l) {
        const float x = toX[l] - fromX[l], y = toY[l] - fromY[l], z = toZ[l] - fromZ[l];
        const float squared = x * x + y * y + z * z;
        const bool good = squared > tiny;
        const float inverse = 1.0f / __builtin_sqrtf(good ? squared : 1.0f);
        t.x[l] = good ? x * inverse : t.x[l];
        t.y[l] = good ? y * inverse : t.y[l];
        t.z[l] = good ? z * inverse : t.z[l];
    }
}

// The part of `r` across `t`, unit length. Where `r` runs along `t`, an axis across takes its place.
static inline void straighten(const Vectors& t, Vectors& r, float least) {
    for (int l = 0; l < lanes; ++l) {
        const float tx = t.x[l], ty = t.y[l], tz = t.z[l];
        const float along = r.x[l] * tx + r.y[l] * ty + r.z[l] * tz;
        const float x = r.x[l] - tx * along, y = r.y[l] - ty * along, z = r.z[l] - tz * along;
        const float squared = x * x + y * y + z * z;
        // The y axis, or z for steep hair: both mirror with the head.
        const bool steep = ty > 0.9f || ty < -0.9f;
        const float ay = steep ? 0.0f : 1.0f, az = steep ? 1.0f : 0.0f;
        const float other = ay * ty + az * tz;
        const float ex = -tx * other, ey = ay - ty * other, ez = az - tz * other;
        const float otherSquared = ex * ex + ey * ey + ez * ez;
        const bool good = squared > least;
        const float inverse = 1.0f / __builtin_sqrtf(good ? squared : otherSquared);
        r.x[l] = (good ? x : ex) * inverse;
        r.y[l] = (good ? y : ey) * inverse;
        r.z[l] = (good ? z : ez) * inverse;
    }
}

// Carries `r` from point to point: reflected in the plane between the points, then in the one that brings the
// reflected tangent onto the new one.
static inline void reflectTwice(const float* fromX, const float* fromY, const float* fromZ, const float* toX,
                                const float* toY, const float* toZ, const Vectors& before, const Vectors& after,
                                Vectors& r) {
    for (int l = 0; l < lanes; ++l) {
        const float vx = toX[l] - fromX[l], vy = toY[l] - fromY[l], vz = toZ[l] - fromZ[l];
        const float c = vx * vx + vy * vy + vz * vz;
        const float twice = c > tiny ? 2.0f / c : 0.0f;
        const float rv = twice * (vx * r.x[l] + vy * r.y[l] + vz * r.z[l]);
        const float tv = twice * (vx * before.x[l] + vy * before.y[l] + vz * before.z[l]);
        const float rx = r.x[l] - rv * vx, ry = r.y[l] - rv * vy, rz = r.z[l] - rv * vz;
        const float tx = before.x[l] - tv * vx, ty = before.y[l] - tv * vy, tz = before.z[l] - tv * vz;
        const float wx = after.x[l] - tx, wy = after.y[l] - ty, wz = after.z[l] - tz;
        const float c2 = wx * wx + wy * wy + wz * wz;
        const float twice2 = c2 > 1e-12f ? 2.0f / c2 : 0.0f;
        const float rw = twice2 * (wx * rx + wy * ry + wz * rz);
        r.x[l] = rx - rw * wx;
        r.y[l] = ry - rw * wy;
        r.z[l] = rz - rw * wz;
    }
}

}  // namespace whorl::frame_steps
