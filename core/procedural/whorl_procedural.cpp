// SPDX-License-Identifier: Apache-2.0
// The C interface: checks what comes in, turns errors and exceptions into a status and a sentence.
#include "core/procedural/whorl_procedural.h"

#include "core/base/hash.h"
#include "core/procedural/procedural_groom.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>

using namespace whorl;
using namespace whorl::procedural;

namespace {

WhorlStatus refuse(WhorlError* error, WhorlStatus status, std::string_view sentence) noexcept {
    if (!error) return status;
    std::size_t size = std::min(sentence.size(), sizeof error->text - 1);
    // Not in the middle of a character.
    while (size < sentence.size() && size > 0 && (static_cast<unsigned char>(sentence[size]) & 0xc0u) == 0x80u) --size;
    std::memcpy(error->text, sentence.data(), size);
    error->text[size] = '\0';
    return status;
}

WhorlStatus refuse(WhorlError* error, WhorlStatus status, const Error& why) noexcept {
    if (why.cancelled) return refuse(error, WHORL_STOPPED, "Stopped by the callback.");
    const bool memory = std::string_view(why.message).ends_with("more memory than there is.");
    return refuse(error, memory ? WHORL_NO_MEMORY : status, why.message);
}

/// No exception goes through the boundary.
template <class Work>
WhorlStatus contained(WhorlError* error, Work&& work) noexcept {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return refuse(error, WHORL_NO_MEMORY, "The hair needs more memory than there is.");
    } catch (const std::exception& exception) {
        return refuse(error, WHORL_BAD_FILE, std::string_view(exception.what()));
    } catch (...) {
        return refuse(error, WHORL_BAD_FILE, "The hair can not be made: something unknown failed.");
    }
}

/// Calls `work` with the checked request.
template <class Work>
WhorlStatus withWish(const WhorlGroom* groom, const WhorlRequest* request, WhorlError* error, Work&& work) noexcept {
    return contained(error, [&] {
        if (!groom || !request) return refuse(error, WHORL_BAD_ARGUMENT, "The groom or the request is NULL.");
        const auto wish = checkedWish(*groom, *request);
        if (!wish) return refuse(error, WHORL_BAD_ARGUMENT, wish.error());
        return work(*wish);
    });
}

template <class Source>
WhorlStatus open(const Source& source, const char* overrides, WhorlGroom** groom, WhorlError* error) {
    OpenFault fault;
    auto opened = openGroom(source, overrides ? std::string_view(overrides) : std::string_view(), fault);
    if (!opened) return refuse(error, fault.badArgument ? WHORL_BAD_ARGUMENT : WHORL_BAD_FILE, opened.error());
    *groom = std::move(*opened).release();
    return WHORL_OK;
}

/// Copies blocks of hair one after another into arrays that are as long as they say.
class Filler {
public:
    explicit Filler(const WhorlHair& hair) : m_hair(hair) {}

    /// False when it does not fit.
    bool add(std::span<const Strands* const> samples) {
        const Strands& first = *samples[0];
        if (first.count() > m_hair.hairs - m_hairs || first.vertexCount() > m_hair.vertices - m_vertices) return false;
        for (std::size_t i = 0; i < first.count(); ++i) {
            const std::size_t at = m_hairs + i;
            if (m_hair.vertex_counts) m_hair.vertex_counts[at] = first.firstVertex[i + 1] - first.firstVertex[i];
        }
        copy(m_hair.ids, first.ids, m_hairs, 1);
        copy(m_hair.members, first.members, m_hairs, 1);
        copy(m_hair.groups, first.groups, m_hairs, 1);
        copy(m_hair.root_uvs, first.rootUvs, m_hairs, 2);
        copy(m_hair.widths, first.widths, m_vertices, 1);
        for (std::size_t v = 0; v < first.vertexCount(); ++v) {
            const std::size_t at = m_vertices + v;
            const glm::vec4& colour = first.colours[v];
            if (m_hair.colours) std::memcpy(m_hair.colours + 3 * at, &colour, 3 * sizeof(float));
            if (m_hair.opacities) m_hair.opacities[at] = colour.w;
        }
        for (std::size_t s = 0; s < samples.size(); ++s) {
            copy(m_hair.positions, samples[s]->positions, s * m_hair.vertices + m_vertices, 3);
            copy(m_hair.normals, samples[s]->normals, s * m_hair.vertices + m_vertices, 3);
        }
        m_hairs += first.count();
        m_vertices += first.vertexCount();
        return true;
    }

    bool full() const { return m_hairs == m_hair.hairs && m_vertices == m_hair.vertices; }

private:
    template <class To, class From, class Memory>
    static void copy(To* to, const std::vector<From, Memory>& from, std::uint64_t at, std::size_t each) {
        static_assert(sizeof(From) % sizeof(To) == 0);
        if (to && !from.empty()) std::memcpy(to + at * each, from.data(), from.size() * sizeof(From));
    }

    const WhorlHair& m_hair;
    std::uint64_t m_hairs = 0;
    std::uint64_t m_vertices = 0;
};

/// Memory of one block, with all arrays.
class Block {
public:
    /// The arrays are good until the next call.
    const WhorlHair& of(std::span<const Strands* const> samples) {
        const std::size_t hairs = samples[0]->count(), vertices = samples[0]->vertexCount();
        m_hair.hairs = hairs;
        m_hair.vertices = vertices;
        grow(m_counts, hairs, m_hair.vertex_counts);
        grow(m_ids, hairs, m_hair.ids);
        grow(m_members, hairs, m_hair.members);
        grow(m_groups, hairs, m_hair.groups);
        grow(m_uvs, hairs * 2, m_hair.root_uvs);
        grow(m_positions, samples.size() * vertices * 3, m_hair.positions);
        grow(m_normals, samples.size() * vertices * 3, m_hair.normals);
        grow(m_widths, vertices, m_hair.widths);
        grow(m_colours, vertices * 3, m_hair.colours);
        grow(m_opacities, vertices, m_hair.opacities);
        Filler(m_hair).add(samples);
        return m_hair;
    }

private:
    template <class T>
    static void grow(std::vector<T>& values, std::size_t count, T*& array) {
        if (values.size() < count) values.resize(count);
        array = values.data();
    }

    WhorlHair m_hair = WHORL_HAIR_INIT;
    std::vector<std::uint32_t> m_counts, m_ids;
    std::vector<std::uint8_t> m_members, m_groups;
    std::vector<float> m_uvs, m_positions, m_normals, m_widths, m_colours, m_opacities;
};

}  // namespace

extern "C" {

uint32_t whorl_version(void) {
    return WHORL_API_MAJOR * 65536u + WHORL_API_MINOR;
}

const char* whorl_version_text(void) {
    return WHORL_VERSION;
}

WhorlStatus whorl_open(const char* path, const char* overrides, WhorlGroom** groom, WhorlError* error) {
    if (groom) *groom = nullptr;
    return contained(error, [&] {
        if (!path || !groom) return refuse(error, WHORL_BAD_ARGUMENT, "The path or the place for the groom is NULL.");
        return open(std::string(path), overrides, groom, error);
    });
}

WhorlStatus whorl_open_memory(const void* bytes, size_t size, const char* overrides, WhorlGroom** groom,
                              WhorlError* error) {
    if (groom) *groom = nullptr;
    return contained(error, [&] {
        if (!bytes || !groom) return refuse(error, WHORL_BAD_ARGUMENT, "The bytes or the place for the groom is NULL.");
        return open(std::span(static_cast<const std::uint8_t*>(bytes), size), overrides, groom, error);
    });
}

void whorl_close(WhorlGroom* groom) {
    delete groom;
}

uint32_t whorl_part_count(const WhorlGroom* groom) {
    return groom ? groom->partCount : 0;
}

uint64_t whorl_hairs_asked(const WhorlGroom* groom) {
    return groom ? static_cast<uint64_t>(std::max(groom->groom.counts->hairs, 0)) : 0;
}

uint32_t whorl_group_count(const WhorlGroom* groom) {
    return groom ? static_cast<uint32_t>(groom->groom.groups->size()) : 0;
}

const char* whorl_group_name(const WhorlGroom* groom, uint32_t group) {
    return group < whorl_group_count(groom) ? (*groom->groom.groups)[group].name.c_str() : nullptr;
}

int whorl_is_animated(const WhorlGroom* groom) {
    return groom && groom->animated ? 1 : 0;
}

int whorl_frames(const WhorlGroom* groom, int32_t* first, int32_t* last, double* frames_per_second) {
    if (!groom || groom->frames.empty()) return 0;
    if (first) *first = groom->frames.first;
    if (last) *last = groom->frames.last;
    if (frames_per_second) *frames_per_second = groom->frames.perSecond;
    return 1;
}

const char* whorl_warning(const WhorlGroom* groom, uint32_t index) {
    return groom && index < groom->warnings.size() ? groom->warnings[index].c_str() : nullptr;
}

float whorl_share_for_count(const WhorlGroom* groom, uint64_t hairs) {
    const uint64_t asked = whorl_hairs_asked(groom);
    return hairs >= asked ? 1.0f : static_cast<float>(static_cast<double>(hairs) / static_cast<double>(asked));
}

float whorl_share_for_scale(const WhorlGroom* groom, float pixels_per_metre) {
    return groom ? shareForScale(*groom, pixels_per_metre) : 1.0f;
}

float whorl_share_for_pixels(const WhorlGroom* groom, const float box[6], float pixels) {
    if (!groom || !box) return 1.0f;
    return shareForPixels(*groom, {{box[0], box[2], box[4]}, {box[1], box[3], box[5]}}, pixels);
}

WhorlStatus whorl_box(const WhorlGroom* groom, const WhorlRequest* request, float box[6], WhorlError* error) {
    return withWish(groom, request, error, [&](const Wish& wish) {
        if (!box) return refuse(error, WHORL_BAD_ARGUMENT, "The place for the box is NULL.");
        const auto bounds = boundsOf(*groom, wish);
        if (!bounds) return refuse(error, WHORL_BAD_FILE, bounds.error());
        for (int axis = 0; axis < 3; ++axis) {
            box[2 * axis] = bounds->min[axis];
            box[2 * axis + 1] = bounds->max[axis];
        }
        return WHORL_OK;
    });
}

WhorlStatus whorl_count(const WhorlGroom* groom, const WhorlRequest* request, uint64_t* hairs, uint64_t* vertices,
                        WhorlError* error) {
    return withWish(groom, request, error, [&](const Wish& wish) {
        const auto count = countHair(*groom, wish);
        if (!count) return refuse(error, WHORL_BAD_FILE, count.error());
        if (hairs) *hairs = count->hairs;
        if (vertices) *vertices = count->vertices;
        return WHORL_OK;
    });
}

WhorlStatus whorl_fill(const WhorlGroom* groom, const WhorlRequest* request, const WhorlHair* hair, WhorlError* error) {
    return withWish(groom, request, error, [&](const Wish& wish) {
        if (!hair || hair->struct_size < sizeof(WhorlHair))
            return refuse(error, WHORL_BAD_ARGUMENT, "The hair to fill was not set up: begin with WHORL_HAIR_INIT.");
        Filler filler(*hair);
        bool fits = true;
        const auto made = streamHair(
            *groom, wish, [&](std::span<const Strands* const> samples) { return fits = filler.add(samples); });
        if (!fits || (made && !filler.full())) {
            return refuse(error, WHORL_BAD_SIZE,
                          "Arrays for " + std::to_string(hair->hairs) + " hairs of " + std::to_string(hair->vertices) +
                              " vertices have not the size of this hair; ask whorl_count with the same request.");
        }
        return made ? WHORL_OK : refuse(error, WHORL_BAD_FILE, made.error());
    });
}

WhorlStatus whorl_stream(const WhorlGroom* groom, const WhorlRequest* request, WhorlSink sink, void* user,
                         WhorlError* error) {
    return withWish(groom, request, error, [&](const Wish& wish) {
        if (!sink) return refuse(error, WHORL_BAD_ARGUMENT, "The callback is NULL.");
        Block block;
        const auto made = streamHair(
            *groom, wish, [&](std::span<const Strands* const> samples) { return sink(&block.of(samples), user) == 0; });
        return made ? WHORL_OK : refuse(error, WHORL_BAD_FILE, made.error());
    });
}

WhorlStatus whorl_digest(const WhorlGroom* groom, const WhorlRequest* request, uint64_t* digest, WhorlError* error) {
    return withWish(groom, request, error, [&](const Wish& wish) {
        if (!digest) return refuse(error, WHORL_BAD_ARGUMENT, "The place for the digest is NULL.");
        Hasher hasher;
        const auto made = streamHair(*groom, wish, [&](std::span<const Strands* const> samples) {
            samples[0]->addTo(hasher);
            return true;
        });
        if (!made) return refuse(error, WHORL_BAD_FILE, made.error());
        *digest = hasher.digest();
        return WHORL_OK;
    });
}

}  // extern "C"
