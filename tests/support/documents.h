// SPDX-License-Identifier: Apache-2.0
// Documents for tests: damaged under right checksums, and the ones of released formats.
#pragma once

#include "core/model/groom.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl::testing {

/// A small document with the changes that `choices` ask for (11 bytes each) in its manifest and its arrays, and with
/// right checksums: reaches what lies behind them. Any choices give some document.
std::vector<std::uint8_t> mutatedDocument(std::span<const std::uint8_t> choices);

/// True when a groom obeys all laws but that of maps, which may be missing.
bool obeysLaws(const Groom& groom);

/// What tests/data/golden/v1.whorl holds. For ever: what parameters mean here is written out, defaults are not used.
Groom goldenGroom();

}  // namespace whorl::testing
