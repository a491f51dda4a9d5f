// SPDX-License-Identifier: Apache-2.0
#include "core/model/parting.h"

#include "core/model/line_ids.h"

namespace whorl {

std::uint32_t nextPartingId(std::span<const Parting> partings) {
    return nextLineId(partings);
}

}  // namespace whorl
