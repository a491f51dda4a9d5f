// SPDX-License-Identifier: Apache-2.0
// Hair grown for tests, and what it is compared by.
#pragma once

#include "core/hair/generate.h"

namespace whorl::testing {

/// By a new generator; empty when that fails.
Strands grown(const Groom& groom, const GenerateOptions& options = {});
/// Every byte of the hair.
std::uint64_t digestOf(const Strands& strands);
/// Hair `i` of `a` has the points and normals of hair `j` of `b`.
bool sameShape(const Strands& a, std::size_t i, const Strands& b, std::size_t j);
/// The same with widths and colours.
bool sameHair(const Strands& a, std::size_t i, const Strands& b, std::size_t j);

}  // namespace whorl::testing
