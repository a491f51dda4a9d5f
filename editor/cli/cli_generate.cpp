// SPDX-License-Identifier: Apache-2.0
// generate and hash: the hair of a groom as a file, and as one number.
#include "core/base/parallel.h"
#include "core/io/hair_file.h"
#include "core/io/package.h"
#include "editor/cli/cli.h"

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::string output;
    std::string part;
    std::optional<std::uint32_t> count;
    float lod = 1.0f;
    std::uint32_t parts = 1;
    std::uint32_t threads = 0;
};

Outcome generate(const Options& options) {
    if (hairFormatFor(options.output) == nullptr) {
        std::string known;
        for (const HairFormat& format : hairFormats())
            known += (known.empty() ? "." : ", .") + std::string(format.suffix);
        return badUsage("-o: hair is written as " + known + "; choose a name that ends so.");
    }
    GenerateOptions generateOptions;
    if (!options.part.empty()) {
        const std::size_t slash = options.part.find('/');
        const auto of =
            slash == std::string::npos ? std::nullopt : wholeNumber(options.part.substr(slash + 1), 1, 4096);
        const auto index = of ? wholeNumber(options.part.substr(0, slash), 1, *of) : std::nullopt;
        if (!index)
            return badUsage("--part: write I/N with I from 1 to N and N up to 4096, not \"" + options.part + "\".");
        generateOptions.part = static_cast<std::uint32_t>(*index - 1);
        generateOptions.partCount = static_cast<std::uint32_t>(*of);
    }
    generateOptions.lod = options.lod;
    const ThreadLimit limit(options.threads);
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    if (options.count) groom->setHairs(*options.count);
    const auto written = writeHair(*groom, generateOptions, options.output, progress());
    if (!written) return badInput(written.error());
    if (*written == 0) note(options.output + ": no hair grows in this groom.");
    return done();
}

Outcome hash(const Options& options) {
    const ThreadLimit limit(options.threads);
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    if (options.count) groom->setHairs(*options.count);
    const auto digest = hairDigest(*groom, options.parts, std::nullopt, progress());
    if (!digest) return badInput(digest.error());
    endProgress();
    return printed(hexDigest(*digest) + "\n");
}

void addCommon(CLI::App* program, const std::shared_ptr<Options>& options) {
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_option("--count", options->count, "Hairs instead of the groom's number")
        ->check(CLI::Range(0u, 10000000u));
    program->add_option("--threads", options->threads, "Threads to use; 0: all")->check(CLI::Range(0u, 1024u));
}

}  // namespace

void addGenerate(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "generate", "Writes the hair of a groom; the format follows the suffix",
                                   [options] { return generate(*options); });
    addCommon(program, options);
    program->add_option("--part", options->part, "Only part I of N, 1/8 to 8/8");
    addLod(*program, options->lod);
    program->add_option("-o,--output", options->output, "File to write")->required();
}

void addHash(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "hash", "Digest of all hair; equal for any number of parts and threads",
                                   [options] { return hash(*options); });
    addCommon(program, options);
    program->add_option("--parts", options->parts, "Generates in so many parts")->check(CLI::Range(1u, 4096u));
}

}  // namespace whorl::cli
