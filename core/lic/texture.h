// SPDX-License-Identifier: Apache-2.0
// Hair texture over a whole mesh, as it is drawn and baked.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace whorl {

struct SurfaceMesh;

/// Square layers in UVs that do not overlap, and the direction of the hair. Layers are immutable and shared: one that
/// is the same object as before has not changed. Row 0 is the top (v = 1).
struct LicTexture {
    template <class T>
    using Layer = std::shared_ptr<const std::vector<T>>;

    int size = 0;                 ///< texels a side; 0: no texture
    Layer<std::uint8_t> light;    ///< size * size: the convolution, 0 to 255; margins around charts are filled
    Layer<std::uint8_t> cover;    ///< size * size: how much hair lies there, 0 to 255
    Layer<std::uint8_t> colours;  ///< 3 * size * size: colour of the hair, sRGB
    Layer<glm::vec2> cornerUvs;   ///< 3 a triangle: those of the mesh, or an own atlas where they overlap
    Layer<glm::vec3> tangents;    ///< 3 a triangle: unit direction of the hair at the corner; zero: none grows
    /// size * size: which corners of the texel's triangle lie on its side of all partings, a bit each (1, 2, 4), and
    /// the triangle's number modulo 32 times 8; null: all do. Between corners on both sides there is no direction that
    /// any hair has.
    Layer<std::uint8_t> sides;
    /// Of `light`, from 0 to 1: what it is on average, and how far from that values usually are (standard deviation
    /// that the parameters lead to); drawn contrast is relative to them, so that no setting washes out.
    float mean = 0.5f;
    float deviation = 0.1f;
    /// The mesh that it was painted for (Groom::mesh): on none but this very object the layers mean anything.
    std::shared_ptr<const SurfaceMesh> mesh;
    std::uint64_t serial = 0;        ///< of this painting in the process; 0: not painted
    std::uint64_t changedSince = 0;  ///< serial of the texture before; 0: there is none
    /// The part of `light`, `cover` and `colours` that differs from the texture before: first texel and past the last
    /// one; both zero: all of it may.
    glm::ivec2 changedFrom{0};
    glm::ivec2 changedTo{0};

    bool empty() const { return size == 0; }
};

/// How light and dark hairs are told from the convolution, which varies the less the longer and finer hairs are.
/// -1 to 1, 0 at the mean: steep around it, flat towards the ends. Colour is multiplied by 1 + contrast * tone.
float licTone(float light, float mean, float deviation);

/// Colour of the hairs of tone 0, linear, for a share of white from 0 to 1: with half of it their own, with less they
/// are darker, with more they go grey and white.
glm::vec3 licColour(const glm::vec3& own, float white);

}  // namespace whorl
