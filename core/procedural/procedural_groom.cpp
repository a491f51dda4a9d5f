// SPDX-License-Identifier: Apache-2.0
#include "core/procedural/procedural_groom.h"

#include "core/base/parallel.h"
#include "core/hair/changes.h"
#include "core/io/document.h"
#include "core/io/json_text.h"
#include "core/io/package_files.h"
#include "core/param/json.h"
#include "core/param/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

using namespace whorl;

Result<const PreparedGroom*> WhorlGroom::prepared() const {
    const std::lock_guard lock(m_mutex);
    if (!m_prepared) {
        Progress silent;
        auto made = PreparedGroom::make(groom, silent);
        // Too little memory may pass: the next call tries again.
        if (!made) return made.error();
        m_prepared = std::move(*made);
    }
    return m_prepared.get();
}

namespace whorl::procedural {
namespace {

constexpr std::uint32_t defaultBlockHairs = 4096;
constexpr std::uint32_t mostBlockHairs = 1u << 16;
// A level of detail makes hairs as wide as this; thinner ones fall between eight by eight samples of a pixel.
constexpr float pixelsAcross = 0.125f;
constexpr float leastShare = 0.001f;

/// Sets each parameter that the JSON text names.
Result<void> applyOverrides(Groom& groom, std::string_view text) {
    const auto changes = parseJson(text, "overrides");
    if (!changes) return changes.error();
    if (!changes->is_object())
        return Error{"overrides: write a JSON object of parameters, {\"counts/hairs\": 200000}."};
    for (const auto& [path, stored] : changes->items()) {
        const auto value = paramValueFromJson(stored);
        if (!value)
            return Error{"overrides: the value of " + path + " is no number, text, flag or list of three numbers."};
        if (const auto set = setGroomValue(groom, path, *value); !set)
            return Error{"overrides: " + path + ": " + set.error().message};
    }
    return {};
}

float meanWidthOf(const Groom& groom) {
    double sum = 0.0, guides = 0.0;
    std::vector<double> ofGroup(groom.groups->size(), 0.0);
    for (std::size_t i = 0; i < groom.guides.count(); ++i)
        if (groom.guides.group(i) < ofGroup.size()) ofGroup[groom.guides.group(i)] += 1.0;
    for (std::size_t g = 0; g < ofGroup.size(); ++g) {
        const GeneralParams& general = (*groom.groups)[g].params.general;
        sum += ofGroup[g] * 0.5 * (double{general.rootThickness.value} + double{general.tipThickness.value});
        guides += ofGroup[g];
    }
    return guides > 0.0 ? static_cast<float>(sum / guides) : 0.0f;
}

Result<std::unique_ptr<WhorlGroom>> prepare(Package package, std::string_view overrides, OpenFault& fault) {
    auto opened = std::make_unique<WhorlGroom>();
    const int partsBefore = package.groom.counts->parts;
    if (!overrides.empty()) {
        if (const auto done = applyOverrides(package.groom, overrides); !done) {
            fault.badArgument = true;
            return done.error();
        }
    }
    const int partsNow = package.groom.counts->parts;
    opened->partCount = package.parts.empty() || partsNow != partsBefore
                            ? static_cast<std::uint32_t>(std::clamp(partsNow, 1, static_cast<int>(maxPackageParts)))
                            : static_cast<std::uint32_t>(package.parts.size());
    if (overrides.empty()) opened->parts = std::move(package.parts);
    opened->frames = package.frames;
    opened->warnings = std::move(package.problems);
    opened->groom = std::move(package.groom);
    opened->animated = isAnimated(opened->groom);
    opened->meanWidth = meanWidthOf(opened->groom);
    return opened;
}

}  // namespace

Result<std::unique_ptr<WhorlGroom>> openGroom(const std::string& path, std::string_view overrides, OpenFault& fault) {
    Progress silent;
    if (isDocument(path)) {
        auto document = openDocument(path, silent);
        if (!document) return document.error();
        Package package;
        package.groom = std::move(document->groom);
        package.problems = std::move(document->problems);
        return prepare(std::move(package), overrides, fault);
    }
    auto package = openPackage(path, silent);
    if (!package) return package.error();
    return prepare(std::move(*package), overrides, fault);
}

Result<std::unique_ptr<WhorlGroom>> openGroom(std::span<const std::uint8_t> document, std::string_view overrides,
                                              OpenFault& fault) {
    auto opened = documentFromBytes(document, "The document in memory");
    if (!opened) return opened.error();
    Package package;
    package.groom = std::move(opened->groom);
    package.problems = std::move(opened->problems);
    return prepare(std::move(package), overrides, fault);
}

Result<void> streamHair(const WhorlGroom& groom, const Wish& wish,
                        const std::function<bool(std::span<const Strands* const>)>& sink) {
    const auto prepared = groom.prepared();
    if (!prepared) return prepared.error();
    std::optional<OneThread> alone;
    if (wish.oneThread) alone.emplace();
    Progress silent;
    return (*prepared)->streamMotion(wish.options, wish.times, wish.blockHairs, sink, silent);
}

Result<HairCount> countHair(const WhorlGroom& groom, const Wish& wish) {
    const PackagePart* part = storedPart(groom, wish);
    const bool still = wish.times.size() == 1 && wish.times[0] == 0.0f;
    if (part && (still || !groom.animated)) return HairCount{part->hairs, part->vertices};
    const auto prepared = groom.prepared();
    if (!prepared) return prepared.error();
    std::optional<OneThread> alone;
    if (wish.oneThread) alone.emplace();
    Progress silent;
    return (*prepared)->count(wish.options, wish.times, silent);
}

Result<Wish> checkedWish(const WhorlGroom& groom, const WhorlRequest& request) {
    if (request.struct_size < sizeof(WhorlRequest))
        return Error{"The request was not set up: begin with WHORL_REQUEST_INIT."};
    Wish wish;
    const std::uint32_t parts = request.part_count > 0 ? request.part_count : groom.partCount;
    if (parts > maxPackageParts) return Error{std::to_string(parts) + " parts are too many; the most is 4096."};
    if (request.part >= parts)
        return Error{"There is no part " + std::to_string(request.part) + "; parts are 0 to " +
                     std::to_string(parts - 1) + "."};
    if (!(request.share >= 0.0f && request.share <= 1.0f)) return Error{"The share of the hairs must be from 0 to 1."};
    if (request.time_count > WHORL_MAX_TIMES)
        return Error{std::to_string(request.time_count) + " motion samples are too many; the most is 64."};
    if (request.time_count > 0 && !request.times) return Error{"There are motion samples but no times."};
    if (request.times) wish.times.assign(request.times, request.times + request.time_count);
    if (!std::ranges::all_of(wish.times, [](float time) { return std::isfinite(time); }))
        return Error{"The time of a motion sample is no finite number."};
    if (wish.times.empty()) wish.times.push_back(0.0f);
    wish.options.part = request.part;
    wish.options.partCount = parts;
    wish.options.lod = request.share;
    wish.blockHairs = std::min(request.block_hairs > 0 ? request.block_hairs : defaultBlockHairs, mostBlockHairs);
    wish.oneThread = (request.flags & WHORL_ONE_THREAD) != 0;
    return wish;
}

const PackagePart* storedPart(const WhorlGroom& groom, const Wish& wish) {
    if (wish.options.partCount != groom.parts.size() || wish.options.lod != 1.0f) return nullptr;
    return &groom.parts[wish.options.part];
}

const Bounds* storedBounds(const WhorlGroom& groom, const Wish& wish, float time) {
    const PackagePart* part = storedPart(groom, wish);
    if (!part) return nullptr;
    if (time == 0.0f || !groom.animated) return &part->bounds;
    // The very time of a frame, as it was exported.
    const double near = std::round(double{time} * groom.frames.perSecond);
    if (!(near >= groom.frames.first && near <= groom.frames.last)) return nullptr;
    const int frame = static_cast<int>(near);
    if (groom.frames.timeOf(frame) != time) return nullptr;
    return &part->frameBounds[static_cast<std::size_t>(frame - groom.frames.first)];
}

Result<Bounds> boundsOf(const WhorlGroom& groom, const Wish& wish) {
    Bounds bounds;
    std::vector<float> missing;
    for (const float time : wish.times) {
        if (const Bounds* stored = storedBounds(groom, wish, time)) {
            if (!stored->empty()) bounds.add(*stored);
        } else {
            missing.push_back(time);
        }
    }
    if (missing.empty()) return bounds;
    // All at once: where vertices are skipped, which ones depends on all of the times.
    const auto made = streamHair(groom, wish, [&](std::span<const Strands* const> samples) {
        const Strands* last = nullptr;
        for (const Strands* sample : samples) {
            if (sample != last) bounds.add(sample->bounds());
            last = sample;
        }
        return true;
    });
    if (!made) return made.error();
    return bounds;
}

float shareForScale(const WhorlGroom& groom, float pixelsPerMetre) {
    if (!(pixelsPerMetre > 0.0f) || !(groom.meanWidth > 0.0f)) return 1.0f;
    return std::clamp(groom.meanWidth * pixelsPerMetre / pixelsAcross, leastShare, 1.0f);
}

float shareForPixels(const WhorlGroom& groom, const Bounds& box, float pixels) {
    if (box.empty() || !(pixels > 0.0f)) return 1.0f;
    const glm::vec3 size = box.size();
    // The shadow of a convex body is a quarter of its surface on average over all directions (Cauchy).
    const float shadow = 0.5f * (size.x * size.y + size.y * size.z + size.z * size.x);
    return shadow > 0.0f ? shareForScale(groom, std::sqrt(pixels / shadow)) : 1.0f;
}

}  // namespace whorl::procedural
