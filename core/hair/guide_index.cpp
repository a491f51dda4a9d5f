// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_index.h"

#include "core/hair/guide_triangles.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>
#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

// What nanoflann reads points through.
struct RootCloud {
    std::vector<GuideRoot> roots;
    std::size_t kdtree_get_point_count() const { return roots.size(); }
    float kdtree_get_pt(std::size_t index, std::size_t axis) const {
        return roots[index].position[static_cast<glm::length_t>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, RootCloud>, RootCloud, 3, std::uint32_t>;

struct Candidate {
    float squared;
    std::uint32_t id;
    std::uint32_t root;
    bool operator<(const Candidate& other) const {
        return squared != other.squared ? squared < other.squared : id < other.id;
    }
};

}  // namespace

struct GuideIndex::Tree {
    RootCloud cloud;
    std::unique_ptr<KdTree> tree;
};

GuideIndex::GuideIndex() = default;
GuideIndex::~GuideIndex() = default;
GuideIndex::GuideIndex(GuideIndex&&) noexcept = default;
GuideIndex& GuideIndex::operator=(GuideIndex&&) noexcept = default;

GuideIndex::GuideIndex(const Groom& groom) : m_partings(*groom.mesh, *groom.partings) {
    for (std::size_t i = 0; i < groom.groups->size(); ++i) m_trees.push_back(std::make_unique<Tree>());
    std::uint32_t index = 0;
    for (std::size_t b = 0; b < groom.guides.blockCount(); ++b) {
        const GuideBlock& block = groom.guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i, ++index) {
            if (block.groups[i] >= m_trees.size() || block.roots[i].triangle >= groom.mesh->triangleCount()) continue;
            m_trees[block.groups[i]]->cloud.roots.push_back(
                {index, block.ids[i], positionAt(*groom.mesh, block.roots[i]), normalAt(*groom.mesh, block.roots[i])});
        }
    }
    for (const auto& tree : m_trees)
        if (!tree->cloud.roots.empty())
            tree->tree = std::make_unique<KdTree>(3, tree->cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8));
    m_triangles.resize(m_trees.size());
    for (std::size_t g = 0; g < m_trees.size(); ++g) {
        if (!(*groom.groups)[g].params.general.fromTriangle() || m_trees[g]->cloud.roots.empty()) continue;
        m_triangles[g] = std::make_unique<GuideTriangles>(groom, *this, g);
    }
}

GuideIndex::GuideIndex(std::vector<GuideRoot> roots, const GuideIndex& like) : m_partings(like.m_partings) {
    m_trees.push_back(std::make_unique<Tree>());
    Tree& tree = *m_trees.back();
    tree.cloud.roots = std::move(roots);
    if (!tree.cloud.roots.empty())
        tree.tree = std::make_unique<KdTree>(3, tree.cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8));
}

std::span<const GuideRoot> GuideIndex::rootsOf(std::size_t group) const {
    if (group >= m_trees.size()) return {};
    return m_trees[group]->cloud.roots;
}

float rootDistanceSquared(const glm::vec3& position, const glm::vec3& normal, const GuideRoot& guide) {
    const glm::vec3 between = position - guide.position;
    const float turned = std::max(0.0f, (1.0f - glm::dot(normal, guide.normal)) * 0.5f);
    const float factor = 1.0f + 8.0f * turned * turned;
    return glm::dot(between, between) * factor * factor;
}

std::size_t GuideIndex::nearest(std::size_t group, const glm::vec3& position, const glm::vec3& normal, int samples,
                                std::span<Neighbour> out) const {
    const std::span<const GuideRoot> roots = rootsOf(group);
    if (roots.empty() || samples < 1) return 0;
    const std::size_t wanted = std::min({static_cast<std::size_t>(samples), roots.size(), out.size(), maxNeighbours});
    // One more than wanted, for the cut-off.
    const std::size_t needed = std::min(wanted + 1, roots.size());
    const float query[3] = {position.x, position.y, position.z};

    // The tree knows only Euclidean distances, which are never longer than ours. So ask for more and more, until those
    // not asked for are farther away than the last one needed.
    constexpr std::size_t atOnce = 64;
    std::array<std::uint32_t, atOnce> fixedFound;
    std::array<float, atOnce> fixedSquared;
    std::array<Candidate, atOnce> fixedCandidates;
    std::vector<std::uint32_t> moreFound;
    std::vector<float> moreSquared;
    std::vector<Candidate> moreCandidates;
    std::size_t most = roots.size();
    for (std::size_t asked = std::min(needed + 3, roots.size());; asked = std::min(asked * 2, most)) {
        std::uint32_t* found = fixedFound.data();
        float* squared = fixedSquared.data();
        Candidate* candidates = fixedCandidates.data();
        if (asked > atOnce) {
            moreFound.resize(asked);
            moreSquared.resize(asked);
            moreCandidates.resize(asked);
            found = moreFound.data();
            squared = moreSquared.data();
            candidates = moreCandidates.data();
        }
        const std::size_t there = m_trees[group]->tree->knnSearch(query, asked, found, squared);
        // Places so far apart that their squared distance is no finite number are not found.
        if (there == 0) return 0;
        if (there < asked) asked = most = there;
        const bool parted = m_partings.near(position, std::sqrt(squared[asked - 1]));
        if (parted) most = std::min(most, std::max(asked, mostLookedAt));
        std::size_t count = 0;
        for (std::size_t i = 0; i < asked; ++i) {
            const GuideRoot& root = roots[found[i]];
            float distance = rootDistanceSquared(position, normal, root);
            if (parted) {
                const float detour = m_partings.detour({position, normal}, {root.position, root.normal});
                if (detour == PartingIndex::separate) continue;
                distance *= detour * detour;
            }
            candidates[count++] = {distance, root.id, found[i]};
        }
        const bool more = asked < most;
        if (more && count < needed) continue;
        const std::size_t sorted = std::min(needed, count);
        std::partial_sort(candidates, candidates + sorted, candidates + count);
        if (more && squared[asked - 1] <= candidates[needed - 1].squared) continue;
        const std::size_t given = std::min(wanted, count);
        for (std::size_t i = 0; i < given; ++i) {
            const GuideRoot& root = roots[candidates[i].root];
            out[i] = {root.guide, 0.0f, &root};
        }
        std::array<float, maxNeighbours> distances, weights;
        for (std::size_t i = 0; i < given; ++i) distances[i] = candidates[i].squared;
        shepardWeights({distances.data(), given}, count > given ? candidates[given].squared : -1.0f, weights);
        for (std::size_t i = 0; i < given; ++i) out[i].weight = weights[i];
        return given;
    }
}

std::size_t GuideIndex::guidesOf(std::size_t group, const GeneralParams& general, const glm::vec3& position,
                                 const glm::vec3& normal, std::span<Neighbour> out) const {
    const std::size_t count = general.fromTriangle() ? inTriangle(group, position, normal, out) : 0;
    return count > 0 ? count : nearest(group, position, normal, general.samples, out);
}

std::size_t GuideIndex::inTriangle(std::size_t group, const glm::vec3& position, const glm::vec3& normal,
                                   std::span<Neighbour> out) const {
    const GuideTriangles* triangles = trianglesOf(group);
    const auto place = triangles ? triangles->nearest(position, normal) : std::nullopt;
    if (!place) return 0;
    const std::span<const GuideRoot> roots = rootsOf(group);
    std::size_t count = 0;
    float sum = 0.0f;
    for (int corner = 0; corner < 3; ++corner) {
        const GuideRoot& root = roots[place->corners[corner]];
        const float detour = m_partings.detour({position, normal}, {root.position, root.normal});
        const float weight = detour == PartingIndex::separate ? 0.0f : place->weights[corner] / (detour * detour);
        if (!(weight > 0.0f)) continue;
        out[count++] = {root.guide, weight, &root};
        sum += weight;
    }
    for (std::size_t i = 0; i < count; ++i) out[i].weight /= sum;
    return count;
}

const GuideTriangles* GuideIndex::trianglesOf(std::size_t group) const {
    return group < m_triangles.size() ? m_triangles[group].get() : nullptr;
}

std::uint32_t GuideIndex::nearestRoot(std::size_t group, const glm::vec3& position) const {
    const float query[3] = {position.x, position.y, position.z};
    std::uint32_t found = 0;
    float squared = 0.0f;
    m_trees[group]->tree->knnSearch(query, 1, &found, &squared);
    return found;
}

float GuideIndex::reach(std::size_t group, const glm::vec3& position, std::size_t count) const {
    constexpr std::size_t most = maxNeighbours + 1;
    std::array<std::uint32_t, most> found;
    std::array<float, most> squared;
    const float query[3] = {position.x, position.y, position.z};
    m_trees[group]->tree->knnSearch(query, std::min(count, most), found.data(), squared.data());
    return std::sqrt(squared[std::min(count, most) - 1]);
}

void GuideIndex::within(std::size_t group, const glm::vec3& position, float radius,
                        std::vector<std::uint32_t>& found) const {
    struct Collect {
        std::vector<std::uint32_t>& found;
        float squared;
        // What nanoflann asks of a set of results.
        std::size_t size() const { return found.size(); }
        bool full() const { return true; }
        bool addPoint(float distance, std::uint32_t index) {
            if (distance < squared) found.push_back(index);
            return true;
        }
        float worstDist() const { return squared; }
        void sort() const {}
    };
    found.clear();
    Collect collect{found, radius * radius};
    const float query[3] = {position.x, position.y, position.z};
    m_trees[group]->tree->findNeighbors(collect, query, {});
}

void shepardWeights(std::span<const float> squared, float beyond, std::span<float> weights) {
    // (R - d) / (R d) = 1 / d - 1 / R; without a next guide R is infinite.
    std::array<double, GuideIndex::maxNeighbours> raw{};
    double sum = 0;
    const bool onRoot = !squared.empty() && squared[0] <= 0.0f;
    const double farthest = beyond < 0.0f ? 0.0 : 1.0 / std::sqrt(double{beyond});
    for (std::size_t i = 0; i < squared.size(); ++i) {
        if (onRoot) {
            raw[i] = squared[i] <= 0.0f ? 1.0 : 0.0;
        } else {
            const double nearer = 1.0 / std::sqrt(double{squared[i]}) - farthest;
            raw[i] = nearer * nearer;
        }
        sum += raw[i];
    }
    // All as far as the next one: no one is nearer.
    if (!(sum > 0)) {
        std::fill_n(raw.begin(), squared.size(), 1.0);
        sum = static_cast<double>(squared.size());
    }
    const double share = 1.0 / sum;
    for (std::size_t i = 0; i < squared.size(); ++i) weights[i] = static_cast<float>(raw[i] * share);
}

bool sameGuideRoots(const GuideSet& a, const GuideSet& b) {
    if (a.count() != b.count() || a.blockCount() != b.blockCount()) return false;
    for (std::size_t i = 0; i < a.blockCount(); ++i) {
        if (a.blockSameAs(i, b)) continue;
        const GuideBlock &x = a.block(i), &y = b.block(i);
        if (x.roots != y.roots || x.ids != y.ids || x.groups != y.groups) return false;
    }
    return true;
}

}  // namespace whorl
