// SPDX-License-Identifier: Apache-2.0
#include "core/model/parting.h"

#include <algorithm>
#include <set>

namespace whorl {

std::uint32_t nextPartingId(std::span<const Parting> partings) {
    std::uint32_t largest = 0;
    for (const Parting& parting : partings) largest = std::max(largest, parting.id);
    if (largest < UINT32_MAX) return largest + 1;
    std::set<std::uint32_t> taken;
    for (const Parting& parting : partings) taken.insert(parting.id);
    std::uint32_t id = 1;
    while (taken.contains(id)) ++id;
    return id;
}

}  // namespace whorl
