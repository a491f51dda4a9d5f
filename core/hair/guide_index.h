// SPDX-License-Identifier: Apache-2.0
// Which guides shape a hair, and how much each counts.
#pragma once

#include "core/model/groom.h"
#include "core/surface/parting_index.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace whorl {

/// A guide's root as hairs see it.
struct GuideRoot {
    std::uint32_t guide = 0;  ///< index in the GuideSet
    std::uint32_t id = 0;
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
};

/// One guide of a hair. The weights of a hair's neighbours add up to 1.
struct Neighbour {
    std::uint32_t guide = 0;
    float weight = 0.0f;
    const GuideRoot* root = nullptr;
};

class GuideTriangles;

/// A KD-tree of guide roots for each group, and triangles of guides for groups that want them. Immutable once built;
/// any thread may ask.
class GuideIndex {
public:
    static constexpr std::size_t maxNeighbours = 20;
    static constexpr std::size_t mostLookedAt = 1024;

    GuideIndex();
    /// Guides of groups that the groom does not have are left out.
    explicit GuideIndex(const Groom& groom);
    /// Other roots, all of group 0, kept apart by the partings of `like`.
    GuideIndex(std::vector<GuideRoot> roots, const GuideIndex& like);
    ~GuideIndex();
    GuideIndex(GuideIndex&&) noexcept;
    GuideIndex& operator=(GuideIndex&&) noexcept;

    /// Roots of a group, in order of the guides.
    std::span<const GuideRoot> rootsOf(std::size_t group) const;

    const PartingIndex& partings() const { return m_partings; }

    /// The up to `samples` guides of the group that are nearest to a root, nearest first, with Shepard weights
    /// ((R - d) / (R d))^2, where R is the distance to the next guide, so that weights go smoothly to zero before
    /// another guide takes a place (Franke and Little; 1 / d^2 when there is no next). At a guide's own root only that
    /// guide counts. Distances are Euclidean, made up to nine times longer as normals turn apart, so that guides on
    /// the other side of a thin sheet (an ear) come last. Equal distances go by id. Guides that a parting separates
    /// from the root are left out, and the way round the end of a parting counts (PartingIndex::detour); where all
    /// are separated there is none. Beside partings at most the `mostLookedAt` nearest guides are looked at. Returns
    /// how many were written.
    std::size_t nearest(std::size_t group, const glm::vec3& position, const glm::vec3& normal, int samples,
                        std::span<Neighbour> out) const;

    /// The guides that a hair of the group has by the group's parameters: the nearest ones, or those of the triangle.
    std::size_t guidesOf(std::size_t group, const GeneralParams& general, const glm::vec3& position,
                         const glm::vec3& normal, std::span<Neighbour> out) const;

    /// The up to three guides of the group whose triangle is nearest to the root (GuideTriangles), with barycentric
    /// weights. Guides beyond a parting count less the longer the way round its end is, and not at all where it
    /// separates. Beyond the outermost guides a hair has the two of the triangles' border, or one. Returns how many
    /// were written: none without triangles or when all three are separated. `out` has room for three.
    std::size_t inTriangle(std::size_t group, const glm::vec3& position, const glm::vec3& normal,
                           std::span<Neighbour> out) const;
    /// Null for groups without.
    const GuideTriangles* trianglesOf(std::size_t group) const;

    /// Place in rootsOf(group), which must not be empty, of the guide nearest to `position`.
    std::uint32_t nearestRoot(std::size_t group, const glm::vec3& position) const;
    /// Euclidean distance from `position` to the guide of the group that is the `count`-th nearest. 1 <= count <=
    /// rootsOf(group).size().
    float reach(std::size_t group, const glm::vec3& position, std::size_t count) const;
    /// Sets `found` to the places in rootsOf(group) of all guides within `radius`, in no order.
    void within(std::size_t group, const glm::vec3& position, float radius, std::vector<std::uint32_t>& found) const;

private:
    struct Tree;
    std::vector<std::unique_ptr<Tree>> m_trees;
    std::vector<std::unique_ptr<GuideTriangles>> m_triangles;  // null for groups without
    PartingIndex m_partings;
};

/// Squared distance between roots as neighbours are chosen by it: see GuideIndex::nearest.
float rootDistanceSquared(const glm::vec3& position, const glm::vec3& normal, const GuideRoot& guide);

/// Weights of GuideIndex::nearest for squared distances, nearest first (at most maxNeighbours). `beyond`: the squared
/// distance to the next guide, or below zero.
void shepardWeights(std::span<const float> squared, float beyond, std::span<float> weights);

/// True when both have the same roots, ids and groups in the same order: an index of one serves the other.
bool sameGuideRoots(const GuideSet& a, const GuideSet& b);

}  // namespace whorl
