// SPDX-License-Identifier: Apache-2.0
#include "tests/support/hair.h"

namespace whorl::testing {
namespace {

template <class Members>
bool sameMembers(const Members& a, std::size_t first, const Members& b, std::size_t other, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (a[first + i] != b[other + i]) return false;
    return true;
}

}  // namespace

Strands grown(const Groom& groom, const GenerateOptions& options) {
    Generator generator;
    Progress progress;
    Result<Strands> strands = generator.generate(groom, options, progress);
    return strands ? std::move(*strands) : Strands{};
}

std::uint64_t digestOf(const Strands& strands) {
    Hasher hasher;
    strands.addTo(hasher);
    return hasher.digest();
}

bool sameShape(const Strands& a, std::size_t i, const Strands& b, std::size_t j) {
    const std::size_t first = a.firstVertex[i], other = b.firstVertex[j], count = a.firstVertex[i + 1] - first;
    return b.firstVertex[j + 1] - other == count && sameMembers(a.positions, first, b.positions, other, count) &&
           sameMembers(a.normals, first, b.normals, other, count);
}

bool sameHair(const Strands& a, std::size_t i, const Strands& b, std::size_t j) {
    const std::size_t first = a.firstVertex[i], other = b.firstVertex[j], count = a.firstVertex[i + 1] - first;
    return sameShape(a, i, b, j) && sameMembers(a.widths, first, b.widths, other, count) &&
           sameMembers(a.colours, first, b.colours, other, count);
}

}  // namespace whorl::testing
