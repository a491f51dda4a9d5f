// SPDX-License-Identifier: Apache-2.0
#include "core/io/container.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"

#include <zstd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>

namespace whorl {
namespace {

constexpr std::size_t headerBytes = 40;
constexpr std::size_t entryBytes = 32;
constexpr int compressionLevel = 1;

template <class T>
void put(std::uint8_t* to, T value) {
    std::memcpy(to, &value, sizeof value);
}

template <class T>
T get(const std::uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

template <class Context, std::size_t (*Free)(Context*)>
struct Freed {
    void operator()(Context* context) const { Free(context); }
};

std::uint64_t headerChecksum(const std::uint8_t* header, std::size_t table) {
    Hasher hasher;
    hasher.add(header, headerBytes - 8);
    hasher.add(header + headerBytes, table);
    return hasher.digest();
}

std::vector<std::uint8_t> compressed(std::span<const std::uint8_t> raw) {
    thread_local const std::unique_ptr<ZSTD_CCtx, Freed<ZSTD_CCtx, ZSTD_freeCCtx>> context(ZSTD_createCCtx());
    std::vector<std::uint8_t> stored(ZSTD_compressBound(raw.size()));
    const std::size_t size =
        ZSTD_compressCCtx(context.get(), stored.data(), stored.size(), raw.data(), raw.size(), compressionLevel);
    if (ZSTD_isError(size)) return {};
    stored.resize(size);
    const std::uint64_t least = (raw.size() + maxInflation - 1) / maxInflation;
    if (size < least) {
        // A frame that readers skip backs the claim of memory with bytes.
        const std::size_t padding = std::max<std::size_t>(least - size, 8);
        stored.resize(size + padding, 0);
        put<std::uint32_t>(stored.data() + size, ZSTD_MAGIC_SKIPPABLE_START);
        put(stored.data() + size + 4, static_cast<std::uint32_t>(padding - 8));
    }
    return stored;
}

}  // namespace

Blob ContainerWriter::add(std::span<const std::uint8_t> bytes) {
    Blob blob{static_cast<std::uint32_t>(m_pieces.size()), 0, bytes.size()};
    for (std::size_t at = 0; at < bytes.size(); at += pieceBytes, ++blob.count)
        m_pieces.push_back(bytes.subspan(at, std::min(pieceBytes, bytes.size() - at)));
    return blob;
}

Blob ContainerWriter::addOwned(std::vector<std::uint8_t> bytes) {
    m_owned.push_back(std::move(bytes));
    return add(m_owned.back());
}

Result<std::vector<std::uint8_t>> ContainerWriter::finish(const ContainerKind& kind, const std::string& manifest,
                                                          Progress& progress) {
    if (manifest.size() > maxManifestBytes) return Error{"There are too many names and parameters for one file."};
    const Blob last = add({reinterpret_cast<const std::uint8_t*>(manifest.data()), manifest.size()});
    const std::size_t count = m_pieces.size();
    std::vector<std::vector<std::uint8_t>> stored(count);
    std::vector<std::uint64_t> checksums(count);
    std::vector<std::uint64_t> rawChecksums(count);
    std::atomic<std::size_t> done{0};
    parallelFor(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !progress.cancelled(); ++i) {
            rawChecksums[i] = hashBytes(m_pieces[i].data(), m_pieces[i].size());
            stored[i] = compressed(m_pieces[i]);
            checksums[i] = hashBytes(stored[i].data(), stored[i].size());
            progress.report(0.6f * static_cast<float>(++done) / static_cast<float>(count), "Compressing");
        }
    });
    if (progress.cancelled()) return cancelledError();

    std::size_t total = headerBytes + count * entryBytes;
    for (const auto& piece : stored) {
        if (piece.empty()) return Error{"Compressing failed: there is not enough memory."};
        total += piece.size();
    }
    std::vector<std::uint8_t> bytes(total);
    std::memcpy(bytes.data(), kind.magic.data(), 8);
    put(bytes.data() + 8, kind.version);
    put(bytes.data() + 12, static_cast<std::uint32_t>(count));
    put(bytes.data() + 16, last.first);
    put(bytes.data() + 24, static_cast<std::uint64_t>(total));
    std::size_t at = headerBytes + count * entryBytes;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint8_t* entry = bytes.data() + headerBytes + i * entryBytes;
        put(entry, static_cast<std::uint64_t>(stored[i].size()));
        put(entry + 8, static_cast<std::uint64_t>(m_pieces[i].size()));
        put(entry + 16, checksums[i]);
        put(entry + 24, rawChecksums[i]);
        std::memcpy(bytes.data() + at, stored[i].data(), stored[i].size());
        at += stored[i].size();
    }
    put(bytes.data() + 32, headerChecksum(bytes.data(), count * entryBytes));
    return bytes;
}

Result<Container> Container::read(std::span<const std::uint8_t> bytes, const ContainerKind& kind,
                                  const std::string& name) {
    const std::string broken = name + " is broken: ";
    if (bytes.size() < 12 || std::memcmp(bytes.data(), kind.magic.data(), 8) != 0)
        return Error{name + " is not " + std::string(kind.label) + "."};
    Container container;
    container.m_name = name;
    container.m_version = get<std::uint32_t>(bytes.data() + 8);
    if (container.m_version > kind.version)
        return Error{name + " was made by a newer Whorl (format " + std::to_string(container.m_version) +
                     "; this one reads up to " + std::to_string(kind.version) + "). Open it with that version."};
    if (bytes.size() < headerBytes) return Error{broken + "it is cut short."};
    const std::uint64_t size = get<std::uint64_t>(bytes.data() + 24);
    if (size != bytes.size())
        return Error{broken + "it has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(size) +
                     ". Use a backup of it."};
    const std::uint64_t count = get<std::uint32_t>(bytes.data() + 12);
    if (count > (bytes.size() - headerBytes) / entryBytes)
        return Error{broken + "it has no room for what it lists. Use a backup of it."};
    const std::size_t table = static_cast<std::size_t>(count) * entryBytes;
    if (headerChecksum(bytes.data(), table) != get<std::uint64_t>(bytes.data() + 32) || container.m_version == 0)
        return Error{broken + "the checksum of its beginning is wrong. Use a backup of it."};

    container.m_manifest = get<std::uint32_t>(bytes.data() + 16);
    container.m_pieces.resize(static_cast<std::size_t>(count));
    std::uint64_t at = headerBytes + table;
    for (std::size_t i = 0; i < container.m_pieces.size(); ++i) {
        const std::uint8_t* entry = bytes.data() + headerBytes + i * entryBytes;
        const std::uint64_t stored = get<std::uint64_t>(entry);
        Piece& piece = container.m_pieces[i];
        piece.raw = get<std::uint64_t>(entry + 8);
        piece.storedChecksum = get<std::uint64_t>(entry + 16);
        piece.rawChecksum = get<std::uint64_t>(entry + 24);
        if (stored > bytes.size() - at || piece.raw == 0 || piece.raw > pieceBytes || piece.raw > stored * maxInflation)
            return Error{broken + "it claims more than it holds. Use a backup of it."};
        piece.stored = bytes.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(stored));
        at += stored;
    }
    if (at != bytes.size()) return Error{broken + "there are bytes that belong to nothing. Use a backup of it."};
    return container;
}

Result<std::string> Container::manifest() {
    std::uint64_t bytes = 0;
    for (std::size_t i = m_manifest; i < m_pieces.size(); ++i) bytes += m_pieces[i].raw;
    const Blob blob{m_manifest,
                    m_manifest < m_pieces.size() ? static_cast<std::uint32_t>(m_pieces.size()) - m_manifest : 0, bytes};
    if (bytes == 0 || bytes > maxManifestBytes || !claim(blob, bytes))
        return Error{m_name + " is broken: its table of contents can not be read. Use a backup of it."};
    std::string text(static_cast<std::size_t>(bytes), '\0');
    const Request request{blob, reinterpret_cast<std::uint8_t*>(text.data())};
    Progress silent;
    if (auto done = inflate({&request, 1}, silent); !done) return done.error();
    return text;
}

bool Container::claim(const Blob& blob, std::uint64_t bytes) {
    if (blob.bytes != bytes || blob.first > m_pieces.size() || blob.count > m_pieces.size() - blob.first) return false;
    std::uint64_t sum = 0;
    for (std::size_t i = blob.first; i < blob.first + blob.count; ++i) {
        const bool last = i + 1 == blob.first + blob.count;
        if (m_pieces[i].claimed || (!last && m_pieces[i].raw != pieceBytes)) return false;
        sum += m_pieces[i].raw;
    }
    if (sum != bytes) return false;
    for (std::size_t i = blob.first; i < blob.first + blob.count; ++i) m_pieces[i].claimed = true;
    return true;
}

bool Container::inflatePiece(const Piece& piece, std::uint8_t* to) const {
    thread_local const std::unique_ptr<ZSTD_DCtx, Freed<ZSTD_DCtx, ZSTD_freeDCtx>> context(ZSTD_createDCtx());
    const auto raw = static_cast<std::size_t>(piece.raw);
    return hashBytes(piece.stored.data(), piece.stored.size()) == piece.storedChecksum &&
           ZSTD_decompressDCtx(context.get(), to, raw, piece.stored.data(), piece.stored.size()) == raw &&
           hashBytes(to, raw) == piece.rawChecksum;
}

Result<void> Container::inflate(std::span<const Request> requests, Progress& progress) const {
    struct Job {
        const Piece* piece;
        std::uint8_t* to;
    };
    std::vector<Job> jobs;
    for (const Request& request : requests) {
        for (std::uint32_t i = 0; i < request.blob.count; ++i)
            jobs.push_back({&m_pieces[request.blob.first + i], request.to + std::size_t{i} * pieceBytes});
    }
    std::atomic<bool> broken{false};
    std::atomic<std::size_t> done{0};
    parallelFor(jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !broken && !progress.cancelled(); ++i) {
            if (!inflatePiece(*jobs[i].piece, jobs[i].to)) broken = true;
            progress.report(static_cast<float>(++done) / static_cast<float>(jobs.size()), "Reading");
        }
    });
    if (broken) return Error{m_name + " is broken: the checksum of a piece is wrong. Use a backup of it."};
    if (progress.cancelled()) return cancelledError();
    return {};
}

std::uint32_t Container::unclaimed() const {
    return static_cast<std::uint32_t>(
        std::count_if(m_pieces.begin(), m_pieces.end(), [](const Piece& piece) { return !piece.claimed; }));
}

Result<void> Container::verify(Progress& progress) const {
    std::atomic<bool> broken{false};
    parallelFor(m_pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> raw(pieceBytes);
        for (std::size_t i = begin; i < end && !broken && !progress.cancelled(); ++i) {
            if (!inflatePiece(m_pieces[i], raw.data())) broken = true;
        }
    });
    if (progress.cancelled()) return cancelledError();
    if (broken) return Error{m_name + " is broken: the checksum of a piece is wrong."};
    return {};
}

}  // namespace whorl
