// SPDX-License-Identifier: Apache-2.0
// Grooms that benchmarks of hair are run on, and how they check it.
#pragma once

#include "core/hair/generate.h"
#include "editor/cli/bench.h"

#include <memory>
#include <string>

namespace whorl {

struct BenchGroomOptions {
    bool outside = false;  ///< hair keeps outside the skin
    bool kink = false;     ///< noise at every vertex besides that of every hair
};

/// A ball of 9 cm with 69,120 triangles, about a head, with 2,000 guides of 16 vertices that fall and wave, four of
/// them to a hair, and frizz.
Groom benchGroom(BenchGroomOptions options = {});

/// A sample ("creature" or "bust") where it lies beside the program, else the ball.
struct BenchDocument {
    std::string name;
    Groom groom;
};
BenchDocument benchDocument(const std::string& sample = "creature");

/// Each hair is a strand of sixteen, which twists around its base hair and stands away from it.
Groom inStrands(Groom groom);

std::uint64_t digestOf(const Strands& strands);

/// All hair in memory, as Generator::generateShared gives it; empty when that failed.
std::shared_ptr<const Strands> made(Generator& generator, const Groom& groom, const GenerateOptions& options);
std::shared_ptr<const Strands> madeAnew(const Groom& groom, const std::shared_ptr<const Surface>& surface,
                                        const GenerateOptions& options);

/// Hairs [first, first + count) of `strands`.
Strands slice(const Strands& strands, std::size_t first, std::size_t count);

/// Same hairs. Each vertex within 3e-6 m, about 1e-5 of a hair's length (0.15 m) and what noise makes of rounding, and
/// 1e-6 m more for each modifier; widths and colours within 1e-6, normals within 1e-2 at
/// 999 vertices of 1000 (they multiply rounding where vertices are close). Where the way out of the skin jumps (the
/// distance field has edges), hairs that stand at such an edge are compared with what the reference makes of its own
/// curve moved by that much before it is kept outside.
bool closeToReference(const Groom& groom, const Surface& surface, const GenerateOptions& options, const Strands& fast,
                      const Strands& reference);

/// A row for so many hairs; the note says threads and SIMD level, then `more`.
BenchRow hairRow(const std::string& name, double hairs, unsigned threads, Medians seconds, const std::string& baseline,
                 const std::string& more = {});

}  // namespace whorl
