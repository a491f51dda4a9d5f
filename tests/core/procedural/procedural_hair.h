// SPDX-License-Identifier: Apache-2.0
// The C interface for tests: opened grooms that close themselves, hair in arrays that can be compared.
#pragma once

#include "core/hair/strands.h"
#include "core/io/package.h"
#include "core/procedural/whorl_procedural.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace whorl::testing {

/// Exports into `package`; an empty path when that failed.
inline std::filesystem::path exported(const Groom& groom, const std::filesystem::path& package, std::uint32_t parts) {
    Progress progress;
    return exportPackage(groom, package, parts, progress) ? package : std::filesystem::path();
}

struct Opened {
    explicit Opened(const std::filesystem::path& path, const char* overrides = nullptr) {
        status = whorl_open(path.c_str(), overrides, &groom, &error);
    }
    Opened(const void* bytes, std::size_t size) { status = whorl_open_memory(bytes, size, nullptr, &groom, &error); }
    ~Opened() { whorl_close(groom); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    operator const WhorlGroom*() const { return groom; }

    WhorlGroom* groom = nullptr;
    WhorlError error{""};
    WhorlStatus status = WHORL_OK;
};

/// All that whorl_fill gives. With several motion samples, positions and normals are those of all.
struct Filled {
    WhorlStatus status = WHORL_OK;
    WhorlError error{""};
    std::vector<std::uint32_t> counts, ids;
    std::vector<std::uint8_t> members, groups;
    std::vector<float> rootUvs, positions, normals, widths, colours, opacities;

    bool operator==(const Filled& o) const {
        return counts == o.counts && ids == o.ids && members == o.members && groups == o.groups &&
               rootUvs == o.rootUvs && positions == o.positions && normals == o.normals && widths == o.widths &&
               colours == o.colours && opacities == o.opacities;
    }

    void append(const WhorlHair& hair, std::size_t samples) {
        const auto add = [](auto& to, const auto* from, std::uint64_t count) {
            if (count > 0) to.insert(to.end(), from, from + count);
        };
        add(counts, hair.vertex_counts, hair.hairs);
        add(ids, hair.ids, hair.hairs);
        add(members, hair.members, hair.hairs);
        add(groups, hair.groups, hair.hairs);
        add(rootUvs, hair.root_uvs, 2 * hair.hairs);
        add(positions, hair.positions, 3 * samples * hair.vertices);
        add(normals, hair.normals, 3 * samples * hair.vertices);
        add(widths, hair.widths, hair.vertices);
        add(colours, hair.colours, 3 * hair.vertices);
        add(opacities, hair.opacities, hair.vertices);
    }
    /// Of one motion sample.
    void append(Filled more) { append(more.view(), 1); }

    WhorlHair view() {
        return {sizeof(WhorlHair), counts.size(),  widths.size(),  counts.data(),    positions.data(),
                normals.data(),    widths.data(),  colours.data(), opacities.data(), rootUvs.data(),
                ids.data(),        members.data(), groups.data()};
    }

    bool equals(const Strands& strands) const {
        std::size_t at = 0;
        if (ids != strands.ids || members != strands.members || groups != strands.groups ||
            !std::ranges::equal(widths, strands.widths) || counts.size() != strands.count())
            return false;
        for (std::size_t i = 0; i < ids.size(); at += counts[i++])
            if (counts[i] != strands.firstVertex[i + 1] - strands.firstVertex[i] ||
                glm::vec2(rootUvs[2 * i], rootUvs[2 * i + 1]) != strands.rootUvs[i])
                return false;
        for (std::size_t v = 0; v < at; ++v) {
            const auto three = [v](const std::vector<float>& a) {
                return glm::vec3(a[3 * v], a[3 * v + 1], a[3 * v + 2]);
            };
            if (three(positions) != strands.positions[v] || three(normals) != strands.normals[v] ||
                glm::vec4(three(colours), opacities[v]) != strands.colours[v])
                return false;
        }
        return at == strands.vertexCount();
    }
};

/// Counts, then fills all arrays.
inline Filled fill(const WhorlGroom* groom, const WhorlRequest& request, std::size_t samples = 0) {
    Filled filled;
    if (samples == 0) samples = std::max(request.time_count, 1u);
    std::uint64_t hairs = 0, vertices = 0;
    filled.status = whorl_count(groom, &request, &hairs, &vertices, &filled.error);
    if (filled.status != WHORL_OK) return filled;
    filled.counts.resize(hairs);
    filled.ids.resize(hairs);
    filled.members.resize(hairs);
    filled.groups.resize(hairs);
    filled.rootUvs.resize(2 * hairs);
    filled.positions.resize(3 * samples * vertices);
    filled.normals.resize(3 * samples * vertices);
    filled.widths.resize(vertices);
    filled.colours.resize(3 * vertices);
    filled.opacities.resize(vertices);
    const WhorlHair hair = filled.view();
    filled.status = whorl_fill(groom, &request, &hair, &filled.error);
    return filled;
}

inline std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> values) {
    std::ranges::sort(values);
    return values;
}

}  // namespace whorl::testing
