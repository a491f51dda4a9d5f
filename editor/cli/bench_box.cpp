// SPDX-License-Identifier: Apache-2.0
// Boxes over rendered curves, against a plain loop over the hairs.
#include "core/base/parallel.h"
#include "core/hair/curve.h"
#include "editor/cli/bench_grooms.h"

namespace whorl {
namespace {

BenchRow box(const std::string& name, const Strands& strands, unsigned threads) {
    const ThreadLimit limit(threads);
    Bounds fast, slow;
    const Medians seconds =
        interleaved([&] { fast = strands.bounds(); },
                    [&] {
                        slow = Bounds();
                        for (std::size_t i = 0; i < strands.count(); ++i) {
                            const std::size_t first = strands.firstVertex[i];
                            const std::size_t count = strands.firstVertex[i + 1] - first;
                            slow.add(strandBounds({&strands.positions[first], count}, {&strands.widths[first], count}));
                        }
                    });
    BenchRow row = hairRow("box/" + name, static_cast<double>(strands.count()), threads, seconds,
                           "strandBounds of each hair, one after another");
    row.correct = fast.min == slow.min && fast.max == slow.max && !fast.empty();
    return row;
}

}  // namespace

std::vector<BenchRow> benchBox() {
    const Groom groom = benchGroom();
    const auto strands = madeAnew(groom, std::make_shared<const Surface>(groom.mesh), {100000u});
    return {box("100k x 16", *strands, 1), box("100k x 16", *strands, 2)};
}

}  // namespace whorl
