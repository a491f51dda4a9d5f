// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: documents as they come, and documents damaged behind right checksums.
#include "core/io/document.h"
#include "tests/support/documents.h"

#include <cstdlib>

namespace {

void open(std::span<const std::uint8_t> bytes) {
    const auto opened = whorl::documentFromBytes(bytes, "fuzzed");
    if (opened ? !whorl::testing::obeysLaws(opened->groom) : opened.error().message.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    open({data, size});
    open(whorl::testing::mutatedDocument({data, size}));
    return 0;
}
