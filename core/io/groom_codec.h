// SPDX-License-Identifier: Apache-2.0
// A groom as pieces of a container and a manifest. Include in sources only.
#pragma once

#include "core/io/container.h"
#include "core/io/document.h"

#include <nlohmann/json_fwd.hpp>

namespace whorl {

/// Adds the arrays of `groom` to `writer` and returns the manifest that finds them. `groom` must outlive the writing.
nlohmann::json encodeGroom(const Groom& groom, ContainerWriter& writer);

/// The way back. Refuses what is not there or can not be; repairs the rest with a sentence each (see groom_repair.h).
Result<OpenedDocument> decodeGroom(Container& container, const nlohmann::json& manifest, const std::string& name,
                                   Progress& progress);

/// [first, count, bytes].
nlohmann::json blobToJson(const Blob& blob);

/// Reads members of a JSON object. The first one that is missing or wrong leaves a sentence in `fault`; then all give
/// zero or nothing, so callers ask once at the end.
class ManifestReader {
public:
    ManifestReader(const nlohmann::json& object, std::string where, std::string& fault);

    std::uint64_t number(const char* key, std::uint64_t max);
    bool flag(const char* key);
    std::string text(const char* key);
    Blob blob(const char* key);
    /// Null when it is not of that type.
    const nlohmann::json* object(const char* key);
    const nlohmann::json* array(const char* key);

private:
    const nlohmann::json* find(const char* key);
    void wrong(const char* key);

    const nlohmann::json* m_object;
    std::string m_where;
    std::string& m_fault;
};

}  // namespace whorl
