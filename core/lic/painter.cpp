// SPDX-License-Identifier: Apache-2.0
#include "core/lic/painter.h"

#include "core/base/parallel.h"
#include "core/lic/painter_state.h"
#include "core/sampling/density.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace whorl {
namespace {

constexpr std::size_t blocksAtOnce = 4;
constexpr std::size_t texelsOfBlock = std::size_t{TexelAtlas::block} * TexelAtlas::block;

const Map* mapOf(const Groom& groom, const std::string& name) {
    const Map* found = name.empty() ? nullptr : groom.maps.find(name);
    return found && !found->empty() ? found : nullptr;
}

}  // namespace

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

// The slots of a block: their light, and what tells hairs apart.
void LicPainter::State::convolve(std::size_t b, int unseen, std::uint8_t* light) {
    const std::uint32_t begin = atlas.firstSlot(b), end = atlas.firstSlot(b + 1);
    const auto even = static_cast<std::uint8_t>(plan.mean * 255.0f + 0.5f);
    landings[b].clear();
    reaches[b] = {};
    bool any = false;
    for (std::uint32_t i = begin; i < end && !any; ++i) any = cover.grows(i);
    if (!any) {
        std::fill(light, light + (end - begin), even);
        std::fill(hair.begin() + begin, hair.begin() + end, std::uint8_t{128});
        return;
    }
    const auto across = static_cast<std::size_t>(atlas.blocksAcross());
    ConvolveBlock block{};
    block.x = static_cast<int>(b % across) * TexelAtlas::block;
    block.y = static_cast<int>(b / across) * TexelAtlas::block;
    block.lengths = lengths.empty() ? nullptr : &lengths[b * texelsOfBlock];
    WHORL_PICK(convolveBlock)(words.arrays(plan), block);
    if (block.landingCount > ConvolveBlock::mostLandings) {
        landings[b].push_back({TexelAtlas::none, 0});
    } else {
        for (int i = 0; i < block.landingCount; ++i) landings[b].push_back({block.landings[i], block.onwards[i]});
    }
    const auto blockOf = [&](int texel) {
        return static_cast<std::int16_t>(std::clamp(texel, 0, atlas.side() - 1) / TexelAtlas::block);
    };
    if (block.left <= block.right)
        reaches[b] = {blockOf(block.left - unseen), blockOf(block.right + unseen), blockOf(block.top - unseen),
                      blockOf(block.bottom + unseen)};
    std::uint8_t* const noise = hair.data() + begin;
    for (std::uint32_t i = 0; i < end - begin; ++i) {
        const std::size_t place = atlas.placeInBlock(begin + i);
        // Where no hair grows, or nothing says which way, light is that of the mean: no dark dots and fringes.
        const bool grows = cover.grows(begin + i) && block.grows[place];
        light[i] = grows ? block.light[place] : even;
        noise[i] = grows ? block.hair[place] : std::uint8_t{128};
    }
}

namespace {

// What a layer becomes: a copy of it, or a new one.
template <class T>
std::shared_ptr<std::vector<T>> nextOf(const LicTexture::Layer<T>& layer, std::size_t count, bool fresh) {
    return fresh || !layer ? std::make_shared<std::vector<T>>(count, T{}) : std::make_shared<std::vector<T>>(*layer);
}

struct Put {
    std::uint32_t texel, from;
};

void put(const std::vector<Put>& places, const std::uint8_t* from, std::uint8_t* to) {
    for (const Put& p : places) to[p.texel] = from[p.from];
}

void put(const std::vector<Put>& places, const std::uint32_t* from, std::uint8_t* to) {
    for (const Put& p : places) {
        std::uint8_t* const texel = to + std::size_t{p.texel} * 3;
        const std::uint32_t colour = from[p.from];
        texel[0] = static_cast<std::uint8_t>(colour);
        texel[1] = static_cast<std::uint8_t>(colour >> 8);
        texel[2] = static_cast<std::uint8_t>(colour >> 16);
    }
}

}  // namespace

// All that is stale of the texture; false when cancelled, then `next` is as it was.
bool LicPainter::State::paintBlocks(const LicStale& stale, bool fresh, LicTexture& next, Progress& progress) {
    const auto size = static_cast<std::size_t>(atlas.size()), across = static_cast<std::size_t>(atlas.blocksAcross());
    std::shared_ptr<std::vector<std::uint8_t>> nextLight, nextCover, nextColours;
    if (anyOf(stale.light)) nextLight = nextOf(next.light, size * size, fresh);
    if (anyOf(stale.cover)) nextCover = nextOf(next.cover, size * size, fresh);
    if (anyOf(stale.colours)) nextColours = nextOf(next.colours, size * size * 3, fresh);
    // A place may have been as far from those that the kernel has seen.
    const int unseen = static_cast<int>(words.longestStep(LicBlocks(stale.light.size(), 1)) * ConvolveBlock::seen) + 2;
    parallelFor(stale.light.size(), blocksAtOnce, [&](std::size_t firstBlock, std::size_t lastBlock) {
        std::uint8_t light[texelsOfBlock], rank[texelsOfBlock], covers[texelsOfBlock];
        std::uint32_t tints[texelsOfBlock];
        std::vector<Put> places;
        for (std::size_t b = firstBlock; b < lastBlock && !progress.cancelled(); ++b) {
            const bool newLight = stale.light[b], newCover = stale.cover[b], newColours = stale.colours[b];
            const std::uint32_t begin = atlas.firstSlot(b), end = atlas.firstSlot(b + 1);
            if (begin == end || !(newLight || newCover || newColours)) continue;
            if (newLight) convolve(b, unseen, light);
            if (newCover || newColours) cover.pixels(b, hair.data() + begin, rank, newCover ? covers : nullptr);
            if (newColours) colours.pixels(b, rank, tints);
            // Where each goes, and which it is of the block.
            const std::size_t left = b % across * TexelAtlas::block - TexelAtlas::pad;  // wraps around in the frame
            const std::size_t top = b / across * TexelAtlas::block - TexelAtlas::pad;
            places.clear();
            for (std::uint32_t i = 0; i < end - begin; ++i) {
                const std::size_t place = atlas.placeInBlock(begin + i);
                const std::size_t x = left + place % TexelAtlas::block, y = top + place / TexelAtlas::block;
                if (x < size && y < size) places.push_back({static_cast<std::uint32_t>(y * size + x), i});
            }
            for (const TexelAtlas::Fill& f : atlas.fills(b)) places.push_back({f.texel, f.slot - begin});
            if (newLight) put(places, light, nextLight->data());
            if (newCover) put(places, covers, nextCover->data());
            if (newColours) put(places, tints, nextColours->data());
        }
    });
    if (progress.cancelled()) return false;
    if (nextLight) next.light = std::move(nextLight);
    if (nextCover) next.cover = std::move(nextCover);
    if (nextColours) next.colours = std::move(nextColours);
    return true;
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
    LicStale stale = s.staleAgainst(groom, field, plan, fresh);
    std::vector<std::uint32_t> turned = s.changes.triangles(fresh ? DirectionField() : s.field, field);
    LicTexture next = s.texture;
    s.painted = false;  // until all is done
    s.groom = groom;
    s.field = field;
    s.plan = plan;
    s.densityScale = DensityLookup(groom).scale();
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
    if (stale.border) {
        s.cover.setBorder(groom.lic->border);
    } else if (anyOf(grown)) {
        s.cover.updateBorder(grown, stale.cover);
    }
    if (anyOf(stale.opacity))
        s.cover.setOpacity(groom.lic->opacity, mapOf(groom, groom.lic->opacity.map), stale.opacity);
    if (stale.ranks) s.cover.setRanks(plan.hairDeviation);
    if (progress.cancelled()) return cancelledError();
    if (anyOf(stale.colours)) s.colours.set(groom, stale.colours);
    if (s.colours.varies()) {
        LicChanges::add(stale.light, stale.colours);
        if (stale.ranks) LicChanges::addAll(stale.colours);
    }

    next.size = s.atlas.size();
    next.cornerUvs = s.atlas.cornerUvs();
    next.mean = plan.mean;
    next.deviation = plan.deviation;
    if (!s.paintBlocks(stale, fresh, next, progress)) return cancelledError();
    if (fresh) next.tangents = nullptr;
    if (fresh || !turned.empty()) s.setTangents(next, turned);

    static std::atomic<std::uint64_t> paintings = 0;
    next.mesh = groom.mesh.share();
    next.changedSince = fresh ? 0 : s.texture.serial;
    next.serial = ++paintings;
    next.changedFrom = next.changedTo = glm::ivec2(0);
    LicBlocks changed = stale.light;
    LicChanges::add(stale.cover, changed);
    LicChanges::add(stale.colours, changed);
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
