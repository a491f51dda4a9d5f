// SPDX-License-Identifier: Apache-2.0
// Copies that leave the caches alone.
#pragma once

#include <cstddef>

namespace whorl {

/// Copies as memcpy does, but writes past the caches where that is possible: for much memory that nobody reads soon,
/// whose old contents would be read in vain first. Other threads see it when the call returns.
void copyPast(const void* from, void* to, std::size_t bytes);

}  // namespace whorl
