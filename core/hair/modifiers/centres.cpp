// SPDX-License-Identifier: Apache-2.0
#include "core/hair/modifiers/centres.h"

#include "core/base/noise.h"
#include "core/base/parallel.h"
#include "core/base/polynomials.h"
#include "core/hair/shaper.h"
#include "core/model/modifiers/rows.h"
#include "core/surface/surface_point.h"

#include <algorithm>
#include <array>

namespace whorl {
namespace {

std::vector<HairRoot> guideRoots(const Groom& groom, const GuideIndex& index, std::size_t group) {
    std::vector<HairRoot> roots;
    for (const GuideRoot& guide : index.rootsOf(group)) {
        HairRoot root;
        root.id = guide.id;
        root.point = groom.guides.root(guide.guide);
        root.position = guide.position;
        root.normal = guide.normal;
        root.uv = uvAt(*groom.mesh, root.point);
        root.group = static_cast<std::uint8_t>(group);
        roots.push_back(root);
    }
    return roots;
}

void placeCentres(ClumpCentres& centres, const Groom& groom, const ModifierChain& chain,
                  const ModifierChain::Clump& clump, const GuideIndex& index, const Scatter& scatter,
                  Progress& progress) {
    const ModifierStep& step = chain.stepOf(clump);
    if (step.numbers[ClumpRows::Centres].value > 0.5f) {
        centres.roots = guideRoots(groom, index, clump.group);
    } else {
        centres.roots = scatter.roots(*groom.mesh, DensityLookup(groom), static_cast<int>(clump.group),
                                      static_cast<std::size_t>(step.numbers[ClumpRows::Count].value),
                                      step.seed ^ static_cast<std::uint32_t>(groom.counts->seed) * 0x9e3779b9u);
        std::erase_if(centres.roots, [&](const HairRoot& root) {
            float random[ModifierArrays::randomRows];
            chain.random(step, ModifierChain::lockKey(root.id), random);
            return random[3] >= step.numbers[ClumpRows::Density].at(root.uv);
        });
    }
    centres.bindings = bindHairs(groom, index, centres.roots, progress);
    // Hair has to come from somewhere: a centre without guides is none.
    std::vector<GuideRoot> places;
    for (std::uint32_t i = 0; i < centres.roots.size() && i < centres.bindings.counts.size(); ++i) {
        const HairRoot& root = centres.roots[i];
        if (centres.bindings.counts[i] > 0) places.push_back({i, root.id, root.position, root.normal});
    }
    centres.index = GuideIndex(std::move(places), index);
}

// Curves of some centres, `which` by place.
void shapeCentres(ClumpCentres& centres, const Groom& groom, const ModifierChain& chain,
                  const ModifierChain::Clump& clump, const GuideShapes& shapes,
                  const std::vector<std::uint32_t>& which) {
    const int segments = std::max((*groom.groups)[clump.group].params.general.segments, 1);
    centres.stride = GuideShapes::stride(segments);
    for (std::vector<float>* row : {&centres.x, &centres.y, &centres.z})
        row->resize(centres.roots.size() * centres.stride);
    std::vector<float> along, ease;
    for (std::size_t v = 0; v < centres.stride; ++v) {
        along.push_back(std::min(1.0f, static_cast<float>(v) / static_cast<float>(segments)));
        ease.push_back(smoothStep(4.0f * along.back()));
    }
    const TraitLookup lookup(groom);
    const ModifierStep& step = chain.stepOf(clump);
    float offset[3];
    chain.noiseOffset(step, offset);
    const bool turned = (*groom.groups)[clump.group].params.general.interpolation.index == 0;
    const ShapeSpace space{turned, centres.stride, along.data(), ease.data(), glm::vec3(0.0f)};
    parallelFor(which.size(), 64, [&](std::size_t begin, std::size_t end) {
        Shaper shaper;
        std::vector<float> made(3 * Shaper::lanes * centres.stride);
        float* axes[3] = {made.data(), &made[Shaper::lanes * centres.stride],
                          &made[2 * Shaper::lanes * centres.stride]};
        for (std::size_t first = begin; first < end; first += Shaper::lanes) {
            const std::size_t count = std::min(Shaper::lanes, end - first);
            for (std::size_t l = 0; l < Shaper::lanes; ++l) {
                const HairRoot& root = centres.roots[which[first + std::min(l, count - 1)]];
                shaper.set(l, root, lookup.lockAt(root));
            }
            shaper.shape(space, shapes, centres.bindings, &which[first], count, axes[0], axes[1], axes[2]);
            for (std::size_t l = 0; l < count; ++l) {
                const std::size_t at = which[first + l] * centres.stride, from = l * centres.stride;
                std::copy_n(axes[0] + from, centres.stride, &centres.x[at]);
                std::copy_n(axes[1] + from, centres.stride, &centres.y[at]);
                std::copy_n(axes[2] + from, centres.stride, &centres.z[at]);
            }
        }
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t centre = which[i];
            const HairRoot& root = centres.roots[centre];
            const std::size_t at = centre * centres.stride;
            const float amplitude = step.numbers[ClumpRows::NoiseAmplitude].at(root.uv),
                        frequency = step.numbers[ClumpRows::NoiseFrequency].at(root.uv);
            if (!(amplitude > 0.0f)) continue;
            float random[ModifierArrays::randomRows];
            chain.random(step, ModifierChain::lockKey(root.id), random);
            for (std::size_t v = 1; v < centres.stride; ++v) {
                float* p[3] = {&centres.x[at + v], &centres.y[at + v], &centres.z[at + v]};
                float noise[3];
                perlinVector(*p[0] * frequency + offset[0] + 256.0f * random[0],
                             *p[1] * frequency + offset[1] + 256.0f * random[1],
                             *p[2] * frequency + offset[2] + 256.0f * random[2], noise);
                for (int axis = 0; axis < 3; ++axis) *p[axis] += amplitude * ease[v] * along[v] * noise[axis];
            }
        }
    });
}

}  // namespace

void ClumpSet::build(const Groom& groom, const ModifierChain& chain, const GuideIndex& index, const GuideShapes& shapes,
                     bool scatterChanged, Progress& progress) {
    const std::span<const ModifierChain::Clump> all = chain.clumps();
    if (scatterChanged || all.empty()) scatter = Scatter();
    clumps.clear();
    clumps.resize(all.size());
    bool scattered = false;
    for (const ModifierChain::Clump& clump : all)
        scattered = scattered || chain.stepOf(clump).numbers[ClumpRows::Centres].value < 0.5f;
    if (scattered && scatter.empty()) scatter = Scatter(*groom.mesh, DensityLookup(groom));
    for (std::size_t c = 0; c < all.size() && !progress.cancelled(); ++c)
        placeCentres(clumps[c], groom, chain, all[c], index, scatter, progress);
    if (progress.cancelled()) return;
    std::vector<std::vector<std::uint8_t>> moved;
    renew(groom, chain, shapes, {}, moved);
}

void ClumpSet::renew(const Groom& groom, const ModifierChain& chain, const GuideShapes& shapes,
                     std::span<const std::uint8_t> changed, std::vector<std::vector<std::uint8_t>>& moved) {
    moved.assign(clumps.size(), {});
    for (std::size_t c = 0; c < clumps.size(); ++c) {
        const Bindings& bindings = clumps[c].bindings;
        moved[c].assign(clumps[c].roots.size(), 0);
        std::vector<std::uint32_t> which;
        for (std::uint32_t i = 0; i < clumps[c].roots.size(); ++i) {
            const std::uint32_t* guides = bindings.guides.data() + i * bindings.perHair;
            const bool touched = changed.empty() || std::any_of(guides, guides + bindings.counts[i],
                                                                [&](std::uint32_t g) { return changed[g] != 0; });
            if (!touched) continue;
            moved[c][i] = 1;
            which.push_back(i);
        }
        shapeCentres(clumps[c], groom, chain, chain.clumps()[c], shapes, which);
    }
}

CentresOfHairs centresOf(const ModifierChain& chain, const ClumpSet& set, std::span<const HairRoot> roots,
                         Progress& progress) {
    CentresOfHairs lists(set.clumps.size());
    for (std::size_t c = 0; c < lists.size(); ++c) {
        lists[c].assign(roots.size(), ClumpCentres::none);
        parallelFor(roots.size(), 1024, [&](std::size_t begin, std::size_t end) {
            if (progress.cancelled()) return;
            std::array<Neighbour, 1> nearest;
            for (std::size_t i = begin; i < end; ++i) {
                const HairRoot& root = roots[i];
                if (root.group != chain.clumps()[c].group) continue;
                if (set.clumps[c].index.nearest(0, root.position, root.normal, 1, nearest) > 0)
                    lists[c][i] = nearest[0].guide;
            }
        });
    }
    return lists;
}

}  // namespace whorl
