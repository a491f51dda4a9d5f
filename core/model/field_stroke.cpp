// SPDX-License-Identifier: Apache-2.0
#include "core/model/field_stroke.h"

#include "core/model/line_ids.h"

namespace whorl {

std::uint32_t nextStrokeId(std::span<const FieldStroke> strokes) {
    return nextLineId(strokes);
}

}  // namespace whorl
