// SPDX-License-Identifier: Apache-2.0
#include "core/io/document.h"

#include "core/io/container.h"
#include "core/io/groom_codec.h"
#include "core/io/guarded.h"
#include "core/io/json_text.h"
#include "core/io/safe_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace whorl {
namespace {

constexpr ContainerKind documentKind{"WHORLDOC", 1, "a Whorl document"};
constexpr std::uint64_t maxDocumentBytes = std::uint64_t{16} << 30;

Result<std::vector<std::uint8_t>> encoded(const Groom& groom, Progress& progress) {
    ContainerWriter writer;
    const nlohmann::json manifest = encodeGroom(groom, writer);
    return writer.finish(documentKind, jsonText(manifest), progress);
}

Result<OpenedDocument> decoded(std::span<const std::uint8_t> bytes, const std::string& name, Progress& progress) {
    auto container = Container::read(bytes, documentKind, name);
    if (!container) return container.error();
    auto text = container->manifest();
    if (!text) return text.error();
    auto manifest = parseJson(*text, name);
    if (!manifest) return manifest.error();
    Problems problems;
    reportUnknownKeys(*manifest, {"mesh", "guides", "maps", "groups", "counts", "partings", "strokes", "field", "lic"},
                      "document", problems);
    auto opened = decodeGroom(*container, *manifest, name, progress);
    if (!opened) return opened;
    opened->problems.insert(opened->problems.begin(), problems.begin(), problems.end());
    // What could not be repaired but does no harm, such as parameters that name maps which are not there.
    for (std::string& problem : checkGroom(opened->groom)) opened->problems.push_back(std::move(problem));
    return opened;
}

}  // namespace

Result<void> saveDocument(const Groom& groom, const std::filesystem::path& file, Progress& progress) {
    const std::string name = file.string();
    return guarded(name, [&]() -> Result<void> {
        auto bytes = encoded(groom, progress);
        if (!bytes) {
            if (bytes.error().cancelled) return bytes.error();
            return Error{name + " could not be saved. " + bytes.error().message};
        }
        auto safe = SafeFile::create(file);
        if (!safe) return safe.error();
        constexpr std::size_t step = std::size_t{16} << 20;
        for (std::size_t at = 0; at < bytes->size(); at += step) {
            if (progress.cancelled()) return cancelledError();
            progress.report(0.6f + 0.2f * static_cast<float>(at) / static_cast<float>(bytes->size()), "Writing");
            if (auto done = safe->write(bytes->data() + at, std::min(step, bytes->size() - at)); !done) return done;
        }
        auto temporary = safe->complete();
        if (!temporary) return temporary.error();

        progress.report(0.8f, "Checking");
        const auto back = readFile(*temporary, maxDocumentBytes);
        if (!back || *back != *bytes)
            return Error{name + " was not saved: what was written reads back differently. The old file is as it was. " +
                         "Save on another disk."};
        auto container = Container::read(*back, documentKind, name);
        if (!container) return container.error();
        if (auto verified = container->verify(progress); !verified) return verified;
        if (auto done = safe->commit(); !done) return done;
        progress.report(1.0f, "Saved");
        return {};
    });
}

Result<OpenedDocument> openDocument(const std::filesystem::path& file, Progress& progress) {
    const std::string name = file.string();
    return guarded(name, [&]() -> Result<OpenedDocument> {
        // Before reading gigabytes of something else.
        if (auto start = readFileStart(file, 1); !start) return start.error();
        if (!isDocument(file)) return Error{name + " is not " + std::string(documentKind.label) + "."};
        const auto bytes = readFile(file, maxDocumentBytes);
        if (!bytes) return bytes.error();
        return decoded(*bytes, name, progress);
    });
}

std::vector<std::uint8_t> documentBytes(const Groom& groom) {
    Progress progress;
    auto bytes = documentBytes(groom, progress);
    return bytes ? std::move(*bytes) : std::vector<std::uint8_t>();
}

Result<std::vector<std::uint8_t>> documentBytes(const Groom& groom, Progress& progress) {
    return guarded("The document", [&] { return encoded(groom, progress); });
}

Result<OpenedDocument> documentFromBytes(std::span<const std::uint8_t> bytes, const std::string& name) {
    Progress progress;
    return documentFromBytes(bytes, name, progress);
}

Result<OpenedDocument> documentFromBytes(std::span<const std::uint8_t> bytes, const std::string& name,
                                         Progress& progress) {
    return guarded(name, [&] { return decoded(bytes, name, progress); });
}

bool isDocument(const std::filesystem::path& file) {
    const auto start = readFileStart(file, documentKind.magic.size());
    return start && start->size() == documentKind.magic.size() &&
           std::memcmp(start->data(), documentKind.magic.data(), start->size()) == 0;
}

}  // namespace whorl
