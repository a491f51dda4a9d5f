// SPDX-License-Identifier: Apache-2.0
// Packages against the hair that they stand for, written as it is: size, and the time until hair is there.
#include "core/hair/prepared.h"
#include "core/io/container.h"
#include "core/io/package.h"
#include "core/io/safe_file.h"
#include "editor/cli/bench_grooms.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

namespace whorl {
namespace {

namespace fs = std::filesystem;

constexpr ContainerKind strandsKind{"WHORLRAW", 1, "hair as it is"};
constexpr int hairs = 100000;

/// A folder that is gone afterwards.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("whorl-bench-" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() {
        std::error_code fault;
        fs::remove_all(path, fault);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

std::uint64_t bytesIn(const fs::path& folder) {
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
    return bytes;
}

/// All arrays that a renderer needs, compressed as packages are. Their sizes are the manifest.
std::vector<std::uint8_t> packed(const Strands& strands) {
    ContainerWriter writer;
    nlohmann::json sizes = nlohmann::json::array();
    const auto add = [&](const auto& values) {
        const Blob blob = writer.addArray(values);
        sizes.push_back({blob.first, blob.count, blob.bytes});
    };
    add(strands.firstVertex);
    add(strands.ids);
    add(strands.members);
    add(strands.groups);
    add(strands.rootUvs);
    add(strands.roots);
    add(strands.positions);
    add(strands.normals);
    add(strands.widths);
    add(strands.colours);
    Progress progress;
    auto bytes = writer.finish(strandsKind, sizes.dump(), progress);
    return bytes ? std::move(*bytes) : std::vector<std::uint8_t>();
}

Strands unpacked(const std::vector<std::uint8_t>& bytes) {
    Strands strands;
    auto container = Container::read(bytes, strandsKind, "hair");
    if (!container) return strands;
    const auto sizes = nlohmann::json::parse(*container->manifest());
    std::vector<Container::Request> requests;
    const auto take = [&](auto& values) {
        const auto& entry = sizes[requests.size()];
        const Blob blob{entry[0], entry[1], entry[2]};
        container->claim(blob, blob.bytes);
        values.resize(static_cast<std::size_t>(blob.bytes / sizeof values[0]));
        requests.push_back({blob, reinterpret_cast<std::uint8_t*>(values.data())});
    };
    take(strands.firstVertex);
    take(strands.ids);
    take(strands.members);
    take(strands.groups);
    take(strands.rootUvs);
    take(strands.roots);
    take(strands.positions);
    take(strands.normals);
    take(strands.widths);
    take(strands.colours);
    Progress progress;
    return container->inflate(requests, progress) ? strands : Strands();
}

void measure(const std::string& name, Groom groom, std::vector<BenchRow>& rows) {
    groom.counts.edit().hairs = hairs;
    const Folder folder;
    const fs::path package = folder.path / "a.groom", raw = folder.path / "hair.raw";
    Progress progress;
    Generator generator;
    const auto all = made(generator, groom, {});
    const std::vector<std::uint8_t> bytes = packed(*all);
    auto file = SafeFile::create(raw);
    const bool written = exportPackage(groom, package, 4, progress).ok() && file.ok() &&
                         file->write(bytes.data(), bytes.size()).ok() && file->commit().ok();
    if (!written) return;
    const double small = static_cast<double>(bytesIn(package)), large = static_cast<double>(bytes.size());
    char note[200];
    std::snprintf(note, sizeof note, "%.2f MB against %.1f MB of hair (%.1f MB in memory): %.1f times smaller, goal 10",
                  small * 1e-6, large * 1e-6, static_cast<double>(all->bytes()) * 1e-6, large / small);

    const auto read = [&] { return unpacked(*readFile(raw, std::uint64_t{1} << 32)); };
    std::shared_ptr<const PreparedGroom> prepared;
    const auto open = [&] {
        auto opened = openPackage(package, progress);
        prepared = *PreparedGroom::make(opened->groom, progress);
    };
    Strands grown, stored;
    BenchRow row{.name = "package/open, " + name + ", 100k hairs",
                 .baseline = "reading the same hair, stored as it is with the same compression",
                 .items = hairs,
                 .unit = "hairs",
                 .note = note};
    // Boxes and counts are there from now on.
    const Medians opening = interleaved([&] { (void)openPackage(package, progress).ok(); }, [&] { stored = read(); });
    row.seconds = opening.ours;
    row.baselineSeconds = opening.baseline;
    row.correct = large >= 10.0 * small;
    rows.push_back(row);

    const Medians preparing = interleaved(open, [&] { stored = read(); });
    row.name = "package/open and prepare, " + name;
    row.note = "two threads at most; nearly all of it is the distance field of the skin";
    row.seconds = preparing.ours;
    row.baselineSeconds = preparing.baseline;
    rows.push_back(row);

    const Medians making = interleaved(
        [&] {
            open();
            grown.clear();
            const auto add = [&](const Strands& block) {
                grown.append(block);
                return true;
            };
            if (!prepared->stream({}, 4096, add, progress)) grown.clear();
        },
        [&] { stored = read(); });
    row.name = "package/open, prepare and make all, " + name;
    row.note = "two threads at most";
    row.seconds = making.ours;
    row.baselineSeconds = making.baseline;
    row.correct = digestOf(grown) == digestOf(*all) && digestOf(stored) == digestOf(*all);
    rows.push_back(row);
}

}  // namespace

std::vector<BenchRow> benchPackage() {
    std::vector<BenchRow> rows;
    for (const char* sample : {"bust", "creature"}) {
        BenchDocument document = benchDocument(sample);
        measure(document.name, std::move(document.groom), rows);
    }
    return rows;
}

}  // namespace whorl
