// SPDX-License-Identifier: Apache-2.0
#include "core/procedural/ri_curves.h"

#include "core/hair/thin.h"
#include "core/procedural/procedural_groom.h"
#include "core/sampling/root_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace whorl::procedural {
namespace {

// Rows for the cubic, square, linear and constant term; columns for the four vertices.
RtBasis catmullRomBasis = {
    {-0.5f, 1.5f, -1.5f, 0.5f}, {1.0f, -2.5f, 2.0f, -0.5f}, {-0.5f, 0.0f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f}};
constexpr RtInt catmullRomStep = 1;

/// Values of one call, with the tokens that name them.
class Parameters {
public:
    template <class T>
    void add(const char* token, const std::vector<T>& values) {
        m_tokens.push_back(const_cast<char*>(token));
        m_values.push_back(const_cast<T*>(values.data()));
    }
    RtInt count() const { return static_cast<RtInt>(m_tokens.size()); }
    RtToken* tokens() { return m_tokens.data(); }
    RtPointer* values() { return m_values.data(); }

private:
    std::vector<RtToken> m_tokens;
    std::vector<RtPointer> m_values;
};

class CurvesSink {
public:
    CurvesSink(const RiHost& host, std::vector<float>& motionTimes, bool normals)
        : m_host(host), m_times(motionTimes), m_withNormals(normals) {}

    static int take(const WhorlHair* block, void* self) {
        static_cast<CurvesSink*>(self)->draw(*block);
        return 0;
    }

private:
    void draw(const WhorlHair& hair) {
        const auto hairs = static_cast<std::size_t>(hair.hairs), vertices = static_cast<std::size_t>(hair.vertices);
        m_counts.clear();
        for (std::size_t i = 0; i < hairs; ++i) m_counts.push_back(static_cast<RtInt>(hair.vertex_counts[i]) + 2);
        m_s.resize(hairs);
        m_t.resize(hairs);
        for (std::size_t i = 0; i < hairs; ++i) {
            m_s[i] = hair.root_uvs[2 * i];
            m_t[i] = hair.root_uvs[2 * i + 1];
        }
        m_ids.clear();
        for (std::size_t i = 0; i < hairs; ++i) m_ids.push_back(static_cast<RtInt>(numberOf(hair.ids[i])));
        m_members.assign(hair.members, hair.members + hairs);
        m_groups.assign(hair.groups, hair.groups + hairs);
        doubled(hair, hair.widths, 1, m_widths);
        m_colours.assign(hair.colours, hair.colours + 3 * vertices);
        m_opacities.resize(3 * vertices);
        for (std::size_t v = 0; v < vertices; ++v) std::fill_n(&m_opacities[3 * v], 3, hair.opacities[v]);

        const std::size_t samples = std::max<std::size_t>(m_times.size(), 1);
        if (samples > 1) m_host.motionBeginV(static_cast<RtInt>(samples), m_times.data());
        for (std::size_t s = 0; s < samples; ++s) {
            doubled(hair, hair.positions + 3 * s * vertices, 3, m_positions);
            if (m_withNormals) m_normals.assign(hair.normals + 3 * s * vertices, hair.normals + 3 * (s + 1) * vertices);
            Parameters parameters;
            parameters.add("vertex point P", m_positions);
            parameters.add("vertex float width", m_widths);
            if (m_withNormals) parameters.add("varying normal N", m_normals);
            parameters.add("varying color Cs", m_colours);
            parameters.add("varying color Os", m_opacities);
            parameters.add("uniform float s", m_s);
            parameters.add("uniform float t", m_t);
            parameters.add("uniform int hair_id", m_ids);
            parameters.add("uniform int hair_member", m_members);
            parameters.add("uniform int hair_group", m_groups);
            m_host.curvesV(const_cast<char*>("cubic"), static_cast<RtInt>(hairs), m_counts.data(),
                           const_cast<char*>("nonperiodic"), parameters.count(), parameters.tokens(),
                           parameters.values());
        }
        if (samples > 1) m_host.motionEnd();
    }

    /// Values of all vertices, `each` a vertex, the first and the last of each hair twice.
    static void doubled(const WhorlHair& hair, const float* values, std::size_t each, std::vector<float>& out) {
        out.clear();
        for (std::size_t i = 0; i < hair.hairs; ++i) {
            const std::size_t count = each * hair.vertex_counts[i];
            out.insert(out.end(), values, values + each);
            out.insert(out.end(), values, values + count);
            out.insert(out.end(), values + count - each, values + count);
            values += count;
        }
    }

    const RiHost& m_host;
    std::vector<float>& m_times;
    bool m_withNormals;
    std::vector<RtInt> m_counts, m_ids, m_members, m_groups;
    std::vector<float> m_positions, m_widths, m_normals, m_colours, m_opacities, m_s, m_t;
};

RtInt codeOf(WhorlStatus status) {
    return status == WHORL_NO_MEMORY ? riNoMemory : riBadFile;
}

}  // namespace

void drawHair(const RiHost& host, const RiRequest& request, SharedGroom& shared, RtFloat detail) {
    WhorlStatus status = WHORL_OK;
    WhorlError error{};
    const WhorlGroom* groom = shared.get(status, error);
    if (!groom) {
        host.tell(codeOf(status), error.text);
        return;
    }
    RiWish wish = wishOf(request, *groom);
    if (request.lod > 0.0f && std::isfinite(detail)) {
        RtBound box;
        WhorlRequest whole = wish.request;
        // That of the still hair, which the package has at hand.
        whole.share = 1.0f;
        whole.times = nullptr;
        whole.time_count = 0;
        if (whorl_box(groom, &whole, box, nullptr) == WHORL_OK && box[0] <= box[1])
            wish.request.share *= whorl_share_for_pixels(groom, box, detail * request.lod * request.lod);
    }
    host.attributeBegin();
    host.basis(catmullRomBasis, catmullRomStep, catmullRomBasis, catmullRomStep);
    CurvesSink sink(host, wish.motionTimes, wantsNormals(groom->groom));
    status = whorl_stream(groom, &wish.request, CurvesSink::take, &sink, &error);
    host.attributeEnd();
    if (status != WHORL_OK) host.tell(codeOf(status), error.text);
}

}  // namespace whorl::procedural
