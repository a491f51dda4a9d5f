// SPDX-License-Identifier: Apache-2.0
#include "core/lic/painter.h"

#include "core/base/parallel.h"
#include "core/lic/lic_changes.h"
#include "core/lic/lic_colours.h"
#include "core/lic/lic_cover.h"
#include "core/lic/lic_words.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace whorl {
namespace {

constexpr std::size_t blocksAtOnce = 4;
constexpr std::size_t texelsOfBlock = std::size_t{TexelAtlas::block} * TexelAtlas::block;

const Map* mapOf(const Groom& groom, const std::string& name) {
    const Map* found = name.empty() ? nullptr : groom.maps.find(name);
    return found && !found->empty() ? found : nullptr;
}

// What has to be made again, one a block.
struct Stale {
    explicit Stale(std::size_t blocks)
        : steps(blocks),
          noise(blocks),
          lengths(blocks),
          light(blocks),
          density(blocks),
          border(blocks),
          opacity(blocks),
          cover(blocks),
          colours(blocks) {}
    LicBlocks steps, noise, lengths, light, density, border, opacity, cover, colours;
    bool partings = false, ranks = false;
};

bool anyOf(const LicBlocks& blocks) {
    return std::ranges::find(blocks, 1) != blocks.end();
}

}  // namespace

struct LicPainter::State {
    explicit State(TexelAtlas texels)
        : atlas(std::move(texels)), words(atlas), cover(atlas), colours(atlas), changes(atlas) {
        light.assign(atlas.slots().size(), 0);
        hair.assign(atlas.slots().size(), 0);
        landings.resize(atlas.blockCount());
    }

    Stale staleAgainst(const Groom& groom, const DirectionField& now, const LicPlan& next, bool fresh) const;
    void densityAgainst(const Groom& groom, Stale& stale) const;
    void coloursAgainst(const Groom& groom, Stale& stale) const;
    void setLengths(const Groom& groom, const LicBlocks& blocks);
    bool convolve(const LicBlocks& blocks, Progress& progress);
    template <class T, class Value>
    void write(std::shared_ptr<const std::vector<T>>& layer, std::size_t channels, const LicBlocks& blocks, bool fresh,
               Value&& value) const;
    void setTangents(LicTexture& texture, std::span<const std::uint32_t> triangles) const;

    const TexelAtlas atlas;
    std::mutex mutex;
    LicWords words;
    LicCover cover;
    LicColours colours;
    const LicChanges changes;
    std::vector<std::uint16_t> lengths;  // by block, empty without a map
    std::vector<std::uint8_t> light;     // one a slot, as `hair`
    std::vector<std::uint8_t> hair;
    std::vector<std::vector<std::uint32_t>> landings;  // by block: those that its streamlines jump to; `none`: many
    // What was painted last.
    bool painted = false;
    Groom groom;
    DirectionField field;
    LicPlan plan;
    LicTexture texture;
};

Result<LicPainter> LicPainter::make(std::shared_ptr<const Surface> surface, int size, Progress& progress,
                                    LicLayout layout) {
    auto atlas = TexelAtlas::make(std::move(surface), size, layout, progress);
    if (!atlas) return atlas.error();
    return LicPainter(std::make_shared<State>(std::move(*atlas)));
}

int LicPainter::size() const {
    return m_state->atlas.size();
}

const TexelAtlas& LicPainter::atlas() const {
    return m_state->atlas;
}

void LicPainter::State::densityAgainst(const Groom& now, Stale& stale) const {
    const bool same = now.groups->size() == groom.groups->size() &&
                      (now.partSettings.sameAs(groom.partSettings) || *now.partSettings == *groom.partSettings);
    if (!same) {
        LicChanges::addAll(stale.density);
        return;
    }
    changes.addMap(groom, groom.counts->groupMap.name, now, now.counts->groupMap.name, stale.density);
    for (std::size_t g = 0; g < now.groups->size(); ++g) {
        const Driven& was = (*groom.groups)[g].params.general.density;
        const Driven& is = (*now.groups)[g].params.general.density;
        if (was.value != is.value) LicChanges::addAll(stale.density);
        changes.addMap(groom, was.map, now, is.map, stale.density);
    }
}

void LicPainter::State::coloursAgainst(const Groom& now, Stale& stale) const {
    bool same = now.groups->size() == groom.groups->size() && now.lic->colourPlace == groom.lic->colourPlace;
    for (std::size_t g = 0; same && g < now.groups->size(); ++g)
        same = (*now.groups)[g].params.colour == (*groom.groups)[g].params.colour;
    const std::vector<std::string> names = LicColours::mapNames(now), before = LicColours::mapNames(groom);
    if (!same || names.size() != before.size()) {
        LicChanges::addAll(stale.colours);
        return;
    }
    for (std::size_t i = 0; i < names.size(); ++i) changes.addMap(groom, before[i], now, names[i], stale.colours);
}

Stale LicPainter::State::staleAgainst(const Groom& now, const DirectionField& nowField, const LicPlan& next,
                                      bool fresh) const {
    Stale stale(atlas.blockCount());
    const LicParams& is = *now.lic;
    const LicParams& was = *groom.lic;
    if (fresh) {
        for (LicBlocks* all : {&stale.steps, &stale.noise, &stale.lengths, &stale.light, &stale.density, &stale.border,
                               &stale.opacity, &stale.cover, &stale.colours})
            LicChanges::addAll(*all);
        stale.partings = stale.ranks = true;
        return stale;
    }
    stale.partings = !now.partings.sameAs(groom.partings) && *now.partings != *groom.partings;
    stale.ranks = next.hairDeviation != plan.hairDeviation;
    if (stale.partings || next.stepMetres != plan.stepMetres || next.longestStep != plan.longestStep)
        LicChanges::addAll(stale.steps);
    changes.addTriangles(changes.triangles(field, nowField), stale.steps);
    if (is.seed != was.seed || next.mean != plan.mean || next.samples != plan.samples || next.grains != plan.grains)
        LicChanges::addAll(stale.noise);
    changes.addMap(groom, was.grain.map, now, is.grain.map, stale.noise);
    if (next.longest != plan.longest || is.length.value != was.length.value) LicChanges::addAll(stale.lengths);
    changes.addMap(groom, was.length.map, now, is.length.map, stale.lengths);
    densityAgainst(now, stale);
    changes.addTriangles(changes.grown(field, nowField), stale.density);

    if (anyOf(stale.steps) || anyOf(stale.noise)) {
        LicChanges::add(stale.steps, stale.light);
        LicChanges::add(stale.noise, stale.light);
        atlas.spread(stale.light, next.longestStep * static_cast<float>(next.steps), false);
        // Streamlines that come there over a seam: so far they have gone as they went last time.
        const LicBlocks near = stale.light;
        for (std::size_t b = 0; b < landings.size(); ++b)
            for (const std::uint32_t there : landings[b])
                stale.light[b] = stale.light[b] | (there == TexelAtlas::none ? std::uint8_t{1} : near[there]);
    }
    LicChanges::add(stale.lengths, stale.light);
    if (next.weights != plan.weights || next.steps != plan.steps) LicChanges::addAll(stale.light);
    LicChanges::add(stale.density, stale.border);
    if (anyOf(stale.border)) atlas.spread(stale.border, cover.borderReach(is.border) + 1.0f, true);
    if (is.border != was.border) LicChanges::addAll(stale.border);
    if (is.opacity.value != was.opacity.value) LicChanges::addAll(stale.opacity);
    changes.addMap(groom, was.opacity.map, now, is.opacity.map, stale.opacity);
    for (const LicBlocks* part : {&stale.light, &stale.density, &stale.border, &stale.opacity})
        LicChanges::add(*part, stale.cover);
    if (stale.ranks) LicChanges::addAll(stale.cover);
    coloursAgainst(now, stale);
    return stale;
}

void LicPainter::State::setLengths(const Groom& now, const LicBlocks& blocks) {
    const Map* map = mapOf(now, now.lic->length.map);
    if (!map) {
        lengths.clear();
        return;
    }
    lengths.resize(atlas.blockCount() * texelsOfBlock, lic_word::one);
    const float scale = plan.longest > 0.0f ? now.lic->length.value / plan.longest : 0.0f;
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            for (std::uint32_t i = atlas.firstSlot(b); i < atlas.firstSlot(b + 1); ++i) {
                const TexelAtlas::Slot& slot = atlas.slots()[i];
                const float share = scale * map->sample(uvAt(atlas.mesh(), slot.point()));
                const float limited = share > 0.0f ? std::min(share, 1.0f) : 0.0f;
                lengths[b * texelsOfBlock + atlas.placeInBlock(i)] =
                    static_cast<std::uint16_t>(limited * static_cast<float>(lic_word::one) + 0.5f);
            }
        }
    });
}

bool LicPainter::State::convolve(const LicBlocks& blocks, Progress& progress) {
    const ConvolveArrays arrays = words.arrays(plan);
    const auto kernel = WHORL_PICK(convolveBlock);
    const auto across = static_cast<std::size_t>(atlas.blocksAcross());
    const auto even = static_cast<std::uint8_t>(plan.mean * 255.0f + 0.5f);
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        ConvolveBlock block{};
        for (std::size_t b = first; b < last && !progress.cancelled(); ++b) {
            const std::uint32_t begin = atlas.firstSlot(b), end = atlas.firstSlot(b + 1);
            if (!blocks[b] || begin == end) continue;
            bool any = false;
            for (std::uint32_t i = begin; i < end && !any; ++i) any = cover.grows(i);
            landings[b].clear();
            if (!any) {
                std::fill(light.begin() + begin, light.begin() + end, even);
                std::fill(hair.begin() + begin, hair.begin() + end, std::uint8_t{128});
                continue;
            }
            block.x = static_cast<int>(b % across) * TexelAtlas::block;
            block.y = static_cast<int>(b / across) * TexelAtlas::block;
            block.lengths = lengths.empty() ? nullptr : &lengths[b * texelsOfBlock];
            kernel(arrays, block);
            landings[b].assign(block.landings,
                               block.landings + std::min(block.landingCount, ConvolveBlock::mostLandings));
            if (block.landingCount > ConvolveBlock::mostLandings) landings[b].assign(1, TexelAtlas::none);
            for (std::uint32_t i = begin; i < end; ++i) {
                const std::size_t place = atlas.placeInBlock(i);
                // Where no hair grows, or nothing says which way, light is that of the mean: no dark dots and fringes.
                const bool grows = cover.grows(i) && words.grows(i);
                light[i] = grows ? block.light[place] : even;
                hair[i] = grows ? block.hair[place] : 128;
            }
        }
    });
    return !progress.cancelled();
}

// A copy of the layer with the texels of some blocks, and those filled from there, set to what `value` gives of a slot.
template <class T, class Value>
void LicPainter::State::write(std::shared_ptr<const std::vector<T>>& layer, std::size_t channels,
                              const LicBlocks& blocks, bool fresh, Value&& value) const {
    const auto size = static_cast<std::size_t>(atlas.size());
    std::shared_ptr<std::vector<T>> next;
    if (fresh || !layer) {
        next = std::make_shared<std::vector<T>>(size * size * channels, T{});
    } else {
        next = std::make_shared<std::vector<T>>(*layer);
    }
    const auto across = static_cast<std::size_t>(atlas.blocksAcross());
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            const std::size_t left = b % across * TexelAtlas::block - TexelAtlas::pad;  // wraps around in the frame
            const std::size_t top = b / across * TexelAtlas::block - TexelAtlas::pad;
            for (std::uint32_t i = atlas.firstSlot(b); i < atlas.firstSlot(b + 1); ++i) {
                const std::size_t place = atlas.placeInBlock(i);
                const std::size_t x = left + place % TexelAtlas::block, y = top + place / TexelAtlas::block;
                if (x < size && y < size) value(i, next->data() + (y * size + x) * channels);
            }
            for (const TexelAtlas::Fill& f : atlas.fills(b)) value(f.slot, next->data() + f.texel * channels);
        }
    });
    layer = std::move(next);
}

void LicPainter::State::setTangents(LicTexture& next, std::span<const std::uint32_t> triangles) const {
    const SurfaceMesh& mesh = atlas.mesh();
    const std::size_t count = mesh.triangles.size() * 3;
    auto tangents = next.tangents && next.tangents->size() == count
                        ? std::make_shared<std::vector<glm::vec3>>(*next.tangents)
                        : std::make_shared<std::vector<glm::vec3>>(count, glm::vec3(0.0f));
    const std::span<const glm::vec3> directions = field.vertices();
    const std::span<const std::uint8_t> grows = field.grows();
    parallelFor(triangles.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t t = triangles[i];
            for (int k = 0; k < 3; ++k)
                (*tangents)[std::size_t{t} * 3 + static_cast<std::size_t>(k)] =
                    !grows.empty() && grows[t] ? directions[mesh.triangles[t][k]] : glm::vec3(0.0f);
        }
    });
    next.tangents = std::move(tangents);
}

Result<LicTexture> LicPainter::paint(const Groom& groom, const DirectionField& field, const LicTexture* before,
                                     Progress& progress) const {
    State& s = *m_state;
    const std::lock_guard lock(s.mutex);
    const bool fresh = !s.painted || !before || before->size != s.texture.size || before->light != s.texture.light ||
                       before->cover != s.texture.cover || before->colours != s.texture.colours ||
                       before->tangents != s.texture.tangents;
    const LicPlan plan = licPlan(*groom.lic, s.atlas, mapOf(groom, groom.lic->length.map));
    Stale stale = s.staleAgainst(groom, field, plan, fresh);
    std::vector<std::uint32_t> turned = s.changes.triangles(fresh ? DirectionField() : s.field, field);
    LicTexture next = s.texture;
    s.painted = false;  // until all is done
    s.groom = groom;
    s.field = field;
    s.plan = plan;
    if (stale.partings) s.words.setPartings(*groom.partings);
    if (anyOf(stale.steps)) s.words.setSteps(field, plan, stale.steps);
    if (progress.cancelled()) return cancelledError();
    if (anyOf(stale.noise))
        s.words.setNoise(plan, static_cast<std::uint32_t>(groom.lic->seed), mapOf(groom, groom.lic->grain.map),
                         stale.noise);
    if (anyOf(stale.lengths)) s.setLengths(groom, stale.lengths);
    if (progress.cancelled()) return cancelledError();
    // Places that get hair or lose it have light of another kind.
    LicBlocks grown(stale.light.size());
    if (anyOf(stale.density)) s.cover.setDensity(groom, field, stale.density, grown);
    LicChanges::add(grown, stale.light);
    LicChanges::add(grown, stale.cover);
    if (anyOf(stale.border)) s.cover.setBorder(groom.lic->border, stale.border);
    if (anyOf(stale.opacity))
        s.cover.setOpacity(groom.lic->opacity, mapOf(groom, groom.lic->opacity.map), stale.opacity);
    if (stale.ranks) s.cover.setRanks(plan.hairDeviation);
    if (progress.cancelled()) return cancelledError();
    if (anyOf(stale.light) && !s.convolve(stale.light, progress)) return cancelledError();

    next.size = s.atlas.size();
    next.cornerUvs = s.atlas.cornerUvs();
    next.mean = plan.mean;
    next.deviation = plan.deviation;
    if (anyOf(stale.light))
        s.write(next.light, 1, stale.light, fresh, [&](std::uint32_t i, std::uint8_t* to) { *to = s.light[i]; });
    if (anyOf(stale.cover))
        s.write(next.cover, 1, stale.cover, fresh,
                [&](std::uint32_t i, std::uint8_t* to) { *to = s.cover.cover(i, s.hair[i]); });
    if (anyOf(stale.colours)) s.colours.set(groom, stale.colours);
    if (s.colours.varies()) {
        LicChanges::add(stale.light, stale.colours);
        if (stale.ranks) LicChanges::addAll(stale.colours);
    }
    if (anyOf(stale.colours)) {
        s.write(next.colours, 3, stale.colours, fresh, [&](std::uint32_t i, std::uint8_t* to) {
            const LicColour colour = s.colours.at(i, s.cover.rank(s.hair[i]));
            std::copy_n(colour.data(), 3, to);
        });
    }
    if (fresh) next.tangents = nullptr;
    if (fresh || !turned.empty()) s.setTangents(next, turned);

    next.changedFrom = next.changedTo = glm::ivec2(0);
    LicBlocks changed = stale.light;
    LicChanges::add(stale.cover, changed);
    if (!fresh && anyOf(changed)) {
        const int across = s.atlas.blocksAcross(), size = s.atlas.size();
        glm::ivec2 from(size), to(0);
        for (int b = 0; b < static_cast<int>(changed.size()); ++b) {
            if (!changed[static_cast<std::size_t>(b)]) continue;
            const glm::ivec2 first(b % across * TexelAtlas::block - TexelAtlas::pad,
                                   b / across * TexelAtlas::block - TexelAtlas::pad);
            from = glm::min(from, first - TexelAtlas::fill);
            to = glm::max(to, first + TexelAtlas::block + TexelAtlas::fill);
        }
        next.changedFrom = glm::clamp(from, 0, size);
        next.changedTo = glm::clamp(to, 0, size);
    }
    s.texture = next;
    s.painted = true;
    return next;
}

}  // namespace whorl
