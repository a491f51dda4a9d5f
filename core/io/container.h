// SPDX-License-Identifier: Apache-2.0
// The container of documents and package parts: compressed pieces with checksums, and a JSON manifest.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Little-endian. Header of 40 bytes: magic (8), version u32, pieces u32, first piece of the manifest u32, zero u32,
// bytes of the file u64, checksum u64 of the 32 bytes before and of the table. Then the table, 32 bytes a piece: stored
// bytes u64, raw bytes u64, checksum u64 of the stored and u64 of the raw bytes. Then the pieces, one after another
// without gaps: zstd frames of at most pieceBytes raw bytes. Pieces are never smaller than 1/200 of their raw bytes
// (padded by a skippable frame), so a small file can not claim much memory. Every byte is under a checksum.

namespace whorl {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files hold the memory's byte order");

/// A run of bytes in a container: consecutive pieces, all full but the last.
struct Blob {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint64_t bytes = 0;
};

/// What a kind of container is called, in its first bytes and to the artist.
struct ContainerKind {
    std::string_view magic;  ///< 8 characters
    std::uint32_t version;   ///< written, and the newest that can be read
    std::string_view label;  ///< "a Whorl document"
};

inline constexpr std::size_t pieceBytes = std::size_t{1} << 20;
inline constexpr std::uint64_t maxInflation = 200;
inline constexpr std::size_t maxManifestBytes = std::size_t{4} << 20;

class ContainerWriter {
public:
    /// The bytes must outlive `finish`.
    Blob add(std::span<const std::uint8_t> bytes);
    Blob addOwned(std::vector<std::uint8_t> bytes);
    template <class T, class Memory>
    Blob addArray(const std::vector<T, Memory>& values) {
        return add({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)});
    }

    /// The whole file. The same input gives the same bytes on any number of threads.
    Result<std::vector<std::uint8_t>> finish(const ContainerKind& kind, const std::string& manifest,
                                             Progress& progress);

private:
    std::vector<std::span<const std::uint8_t>> m_pieces;
    std::deque<std::vector<std::uint8_t>> m_owned;
};

/// A container in memory, its header and table checked. Refers to the bytes, which must outlive it.
class Container {
public:
    /// `name` is the file for the sentences.
    static Result<Container> read(std::span<const std::uint8_t> bytes, const ContainerKind& kind,
                                  const std::string& name);

    std::uint32_t version() const { return m_version; }
    std::uint32_t pieceCount() const { return static_cast<std::uint32_t>(m_pieces.size()); }
    std::uint64_t rawBytes(std::uint32_t piece) const { return m_pieces[piece].raw; }
    Result<std::string> manifest();

    struct Request {
        Blob blob;
        std::uint8_t* to;  ///< blob.bytes bytes
    };
    /// True when the blob is there, has `bytes` bytes and was not claimed before. Claim before allocating: all that can
    /// be claimed together is at most maxInflation times the file.
    bool claim(const Blob& blob, std::uint64_t bytes);
    /// Inflates blobs that were claimed, checking both checksums of each piece.
    Result<void> inflate(std::span<const Request> requests, Progress& progress) const;
    /// Pieces that nobody claimed.
    std::uint32_t unclaimed() const;
    /// Inflates and checks everything without keeping it.
    Result<void> verify(Progress& progress) const;

private:
    struct Piece {
        std::span<const std::uint8_t> stored;
        std::uint64_t raw = 0;
        std::uint64_t storedChecksum = 0;
        std::uint64_t rawChecksum = 0;
        bool claimed = false;
    };
    bool inflatePiece(const Piece& piece, std::uint8_t* to) const;

    std::string m_name;
    std::vector<Piece> m_pieces;
    std::uint32_t m_manifest = 0;
    std::uint32_t m_version = 0;
};

}  // namespace whorl
