// SPDX-License-Identifier: Apache-2.0
// The order of elimination, and which unknowns share a front.
#include "core/field/front_solver.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>

namespace whorl {
namespace {

/// Whether a front of `pivots` over `rest` rows shall be one with its parent's. The limits are those usual for
/// relaxed supernodes.
bool worthJoining(std::size_t pivots, std::size_t rest, std::size_t parentPivots, std::size_t parentRest) {
    const auto size = [](std::size_t p, std::size_t r) { return static_cast<double>(p * (p + 1) / 2 + p * r); };
    const std::size_t all = pivots + parentPivots;
    const double joined = size(all, parentRest);
    const double zeros = (joined - size(pivots, rest) - size(parentPivots, parentRest)) / joined;
    return all <= 4 || (all <= 16 && zeros < 0.25) || (all <= 48 && zeros < 0.1) || zeros < 0.05;
}

}  // namespace

void FrontSolver::order(std::uint32_t unknowns, std::span<const Pair> pairs) {
    if (unknowns == 0) return;
    const auto count = static_cast<int>(unknowns);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Pair& pair : pairs) {
        entries.emplace_back(static_cast<int>(pair.high), static_cast<int>(pair.low), 1.0);
        entries.emplace_back(static_cast<int>(pair.low), static_cast<int>(pair.high), 1.0);
    }
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, 1.0);
    Eigen::SparseMatrix<double> pattern(count, count);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
    Eigen::AMDOrdering<int>()(pattern, found);
    const auto eliminated = [&](std::uint32_t place) {
        return static_cast<std::uint32_t>(found.indices()[static_cast<int>(place)]);
    };
    std::vector<std::uint32_t> placeOf(unknowns);
    for (std::uint32_t place = 0; place < unknowns; ++place) placeOf[eliminated(place)] = place;
    // The elimination tree, and how many rows each column has: rows of a column are those of its children and its own.
    std::vector<std::vector<std::uint32_t>> rows(unknowns), columns(unknowns);
    for (const Pair& pair : pairs) {
        const auto [low, high] = std::minmax(placeOf[pair.low], placeOf[pair.high]);
        rows[low].push_back(high);
    }
    struct Group {
        std::vector<std::uint32_t> places;  // eliminated together, from the first one on
        std::size_t rest;
        std::vector<std::uint32_t> children;
    };
    std::vector<Group> groups(unknowns);
    std::vector<std::uint32_t> roots;
    for (std::uint32_t place = 0; place < unknowns; ++place) {
        std::vector<std::uint32_t>& own = rows[place];
        for (const std::uint32_t child : groups[place].children) {
            own.insert(own.end(), rows[child].begin() + 1, rows[child].end());
            rows[child] = {};
        }
        std::ranges::sort(own);
        own.erase(std::unique(own.begin(), own.end()), own.end());
        groups[place].places = {place};
        groups[place].rest = own.size();
        if (own.empty()) {
            roots.push_back(place);
        } else {
            groups[own.front()].children.push_back(place);
        }
    }
    // Children join their parents where that adds few zeros: larger fronts go faster. From the leaves on.
    for (std::uint32_t place = 0; place < unknowns; ++place) {
        Group& parent = groups[place];
        std::vector<std::uint32_t> kept;
        for (const std::uint32_t c : parent.children) {
            Group& child = groups[c];
            if (!worthJoining(child.places.size(), child.rest, parent.places.size(), parent.rest)) {
                kept.push_back(c);
                continue;
            }
            child.places.insert(child.places.end(), parent.places.begin(), parent.places.end());
            parent.places = std::move(child.places);
            kept.insert(kept.end(), child.children.begin(), child.children.end());
            child = {};
        }
        parent.children = std::move(kept);
    }
    // Numbered children first, without recursion: trees may be deep.
    struct Visit {
        std::uint32_t group;
        std::size_t next;
        std::vector<std::uint32_t> fronts;
    };
    for (const std::uint32_t root : roots) {
        std::vector<Visit> path{{root, 0, {}}};
        while (!path.empty()) {
            Visit& visit = path.back();
            const Group& group = groups[visit.group];
            if (visit.next < group.children.size()) {
                const std::uint32_t child = group.children[visit.next++];
                path.push_back({child, 0, {}});
                continue;
            }
            Front front;
            front.first = static_cast<std::uint32_t>(m_order.size());
            front.pivots = static_cast<std::uint32_t>(group.places.size());
            front.children = std::move(visit.fronts);
            for (const std::uint32_t place : group.places) m_order.push_back(eliminated(place));
            path.pop_back();
            if (!path.empty()) path.back().fronts.push_back(static_cast<std::uint32_t>(m_fronts.size()));
            m_fronts.push_back(std::move(front));
        }
    }
}

}  // namespace whorl
