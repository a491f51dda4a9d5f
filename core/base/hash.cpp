// SPDX-License-Identifier: Apache-2.0
#include "core/base/hash.h"

namespace whorl {

std::string hexDigest(std::uint64_t digest) {
    static const char* digits = "0123456789abcdef";
    std::string text(16, '0');
    for (int i = 15; i >= 0; --i, digest >>= 4) text[static_cast<std::size_t>(i)] = digits[digest & 15];
    return text;
}

}  // namespace whorl
