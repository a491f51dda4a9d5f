// SPDX-License-Identifier: Apache-2.0
// The modifiers of a groom as generation reads them.
#pragma once

#include "core/hair/modifiers/modifiers.kernel.h"
#include "core/hair/roots.h"
#include "core/model/groom.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace whorl {

/// One number of a modifier: value x map, finite and inside the range of its parameter, whatever the map holds.
struct ModifierNumber {
    float value = 0.0f;  ///< without a map finite and inside the range already
    const Map* map = nullptr;
    float least = 0.0f;
    float most = 1.0f;
    float at(glm::vec2 uv) const;
};

/// Place of a block of parameters among the kinds.
template <class Params, std::size_t kind = 0>
constexpr std::size_t modifierKindNumber() {
    if constexpr (std::is_same_v<std::variant_alternative_t<kind, ModifierParams>, Params>) {
        return kind;
    } else {
        return modifierKindNumber<Params, kind + 1>();
    }
}
template <class Params>
inline constexpr std::size_t modifierKindOf = modifierKindNumber<Params>();

/// A modifier that is on.
struct ModifierStep {
    std::size_t kind = 0;
    std::uint32_t seed = 0;  ///< of the modifier and its kind; several of a kind with one seed draw the same numbers
    bool shared = false;     ///< what is random is a lock's and not a hair's
    std::size_t clump = 0;   ///< place in ModifierChain::clumps, for a clump
    std::uint32_t randomRows = 0;  ///< that its kernel reads
    /// In declared order, "on" and the amount first; vectors take three, choices and switches are numbers too.
    std::vector<ModifierNumber> numbers;
};

/// Finds the maps of all modifiers once. Refers to the groom, which must outlive it.
class ModifierChain {
public:
    explicit ModifierChain(const Groom& groom);

    /// Modifiers of a group that move vertices, in their order.
    std::span<const ModifierStep> shapes(std::size_t group) const { return m_groups[group].shapes; }
    /// Those that change widths.
    std::span<const ModifierStep> looks(std::size_t group) const { return m_groups[group].looks; }

    /// A clump of some group.
    struct Clump {
        std::size_t group = 0;
        std::size_t step = 0;  ///< in shapes(group)
    };
    std::span<const Clump> clumps() const { return m_clumps; }
    const ModifierStep& stepOf(const Clump& clump) const { return m_groups[clump.group].shapes[clump.step]; }

    /// Where noise of a step starts; depends on the seeds only.
    void noiseOffset(const ModifierStep& step, float* offset) const;
    /// Random numbers of a step for a hair or a lock, ModifierArrays::randomRows of them, 0 to 1.
    void random(const ModifierStep& step, std::uint64_t key, float* out) const;
    /// The same for many keys: randomFloat(randomSeed(step), key, channelOf(row)).
    std::uint32_t randomSeed(const ModifierStep& step) const;
    static std::uint32_t channelOf(std::uint32_t row);
    /// Keys of hairs and of locks. A lock's is that of its centre, however the list is ordered.
    static std::uint64_t hairKey(std::uint32_t id) { return id; }
    static std::uint64_t lockKey(std::uint32_t centre) { return (std::uint64_t{1} << 40) | centre; }

private:
    struct Steps {
        std::vector<ModifierStep> shapes;
        std::vector<ModifierStep> looks;
    };
    std::uint32_t m_seed = 0;
    std::vector<Steps> m_groups;
    std::vector<Clump> m_clumps;
};

/// The kernel of a kind that moves vertices, at the level in use; null for one that does not.
using ModifierKernel = void (*)(const ModifierArrays&);
ModifierKernel modifierKernel(std::size_t kind);

/// Width that looks with these numbers give at curve parameter `along`, compared with none.
float taperAt(std::span<const float> numbers, float along);
/// True when a group has looks and no map changes them.
bool looksAreEven(const ModifierChain& chain, std::size_t group);
/// Numbers of all looks of a group at a place, TaperRows::count each. Empty without looks.
void lookNumbers(const ModifierChain& chain, std::size_t group, glm::vec2 uv, std::vector<float>& out);

}  // namespace whorl
