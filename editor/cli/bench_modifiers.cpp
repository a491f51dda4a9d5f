// SPDX-License-Identifier: Apache-2.0
// Modifiers, each alone and all together, against the scalar reference of the same hair.
#include "core/base/parallel.h"
#include "core/hair/reference.h"
#include "editor/cli/bench_grooms.h"

#include <utility>

namespace whorl {
namespace {

Groom withModifiers(const std::vector<std::size_t>& kinds) {
    Groom groom = benchGroom();
    std::vector<Modifier>& list = groom.groups.edit()[0].params.modifiers;
    for (const std::size_t kind : kinds) {
        Modifier modifier{freeModifierName(list, modifierKinds()[kind].id)};
        modifier.params = defaultModifierParams(kind);
        list.push_back(std::move(modifier));
    }
    return groom;
}

// Neighbours are kept, all hair is shaped again: by how much longer the scalar chain takes.
BenchRow modified(const std::string& name, Groom groom) {
    const ThreadLimit limit(1);
    constexpr std::uint32_t hairs = 50000;
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Progress progress;
    Generator kept;
    kept.setSurface(surface);
    std::shared_ptr<const Strands> fast = made(kept, groom, {hairs});
    Strands slow;
    bool back = false;
    const Medians seconds = interleaved(
        [&] {
            const float way = std::exchange(back, !back) ? -0.0005f : 0.0005f;
            for (std::size_t g = 0; g < groom.guides.count(); ++g)
                for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p.x += way;
            fast.reset();
            fast = made(kept, groom, {hairs});
        },
        [&] { slow = *generateReference(groom, surface, {hairs}, progress); });
    BenchRow row = hairRow("modifiers/" + name, static_cast<double>(fast->count()), 1, seconds,
                           "scalar reference from nothing, one thread");
    row.correct = closeToReference(groom, *surface, {hairs}, *fast, slow);
    return row;
}

}  // namespace

std::vector<BenchRow> benchModifiers() {
    std::vector<BenchRow> rows{modified("none", withModifiers({}))};
    std::vector<std::size_t> all;
    for (std::size_t kind = 0; kind < modifierKindCount; ++kind) {
        rows.push_back(modified(std::string(modifierKinds()[kind].id), withModifiers({kind})));
        all.push_back(kind);
    }
    rows.push_back(modified("all", withModifiers(all)));
    return rows;
}

}  // namespace whorl
