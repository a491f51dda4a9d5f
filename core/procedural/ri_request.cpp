// SPDX-License-Identifier: Apache-2.0
#include "core/procedural/ri_request.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

namespace whorl::procedural {
namespace {

constexpr int mostSamples = 16;

/// One parameter as it came: numbers, or a text.
struct Given {
    std::string name;
    std::string text{};
    std::vector<float> numbers{};
};

Error wrong(const Given& given, const char* wanted) {
    return {"The parameter " + given.name + " of the hair wants " + wanted + "."};
}

Result<void> set(RiRequest& request, const Given& given) {
    const auto number = [&](float low, float high) -> std::optional<float> {
        if (given.numbers.size() != 1) return std::nullopt;
        const float value = given.numbers[0];
        return value >= low && value <= high ? std::optional(value) : std::nullopt;
    };
    const auto take = [&](auto& to, float low, float high, const char* wanted) -> Result<void> {
        const auto value = number(low, high);
        if (!value) return wrong(given, wanted);
        to = static_cast<std::decay_t<decltype(to)>>(*value);
        return {};
    };
    if (given.name == "package" || given.name == "overrides") {
        if (given.text.empty()) return wrong(given, "a text");
        (given.name == "package" ? request.package : request.overrides) = given.text;
        return {};
    }
    if (given.name == "part") {
        std::uint32_t part = 0;
        if (const auto taken = take(part, 0.0f, 4095.0f, "a number from 0 to 4095"); !taken) return taken;
        request.part = part;
        return {};
    }
    if (given.name == "parts") return take(request.parts, 1.0f, 4096.0f, "a number from 1 to 4096");
    if (given.name == "frame") return take(request.frame, -1e6f, 1e6f, "the number of a frame");
    if (given.name == "fps") return take(request.framesPerSecond, 1e-3f, 1e4f, "frames a second, above 0");
    if (given.name == "samples") return take(request.samples, 1.0f, mostSamples, "a number from 1 to 16");
    if (given.name == "share") return take(request.share, 0.0f, 1.0f, "a number from 0 to 1");
    if (given.name == "lod") return take(request.lod, 0.0f, 1e6f, "a number from 0");
    if (given.name == "shutter") {
        if (given.numbers.size() != 2 || !(given.numbers[0] <= given.numbers[1]))
            return wrong(given, "two numbers, when the shutter opens and when it closes");
        request.shutter = {given.numbers[0], given.numbers[1]};
        return {};
    }
    return Error{"The hair has no parameter " + given.name +
                 "; parameters are package, part, parts, frame, fps, shutter, samples, share, lod, overrides."};
}

Result<RiRequest> checked(RiRequest request) {
    if (request.package.empty()) return Error{"The hair has no package: name it first."};
    return request;
}

/// "1,2.5": all of it, without looking at the locale.
std::optional<std::vector<float>> numbersOf(std::string_view text) {
    std::vector<float> numbers;
    while (true) {
        float value = 0.0f;
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
        numbers.push_back(value);
        if (end == text.data() + text.size()) return numbers;
        if (*end != ',') return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
    }
}

/// The next word, without its quotes; empty at the end.
std::string nextWord(std::string_view& text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text[0]))) text.remove_prefix(1);
    std::string word;
    bool quoted = false;
    for (; !text.empty() && (quoted || !std::isspace(static_cast<unsigned char>(text[0]))); text.remove_prefix(1)) {
        if (text[0] == '\'') {
            quoted = !quoted;
        } else {
            word += text[0];
        }
    }
    return word;
}

}  // namespace

Result<RiRequest> parseRequest(std::string_view text) {
    RiRequest request;
    request.package = nextWord(text);
    for (std::string word = nextWord(text); !word.empty(); word = nextWord(text)) {
        const std::size_t equals = word.find('=');
        Given given{word.substr(0, equals)};
        if (equals == std::string::npos) return Error{"\"" + word + "\": write parameters of the hair as NAME=VALUE."};
        given.text = word.substr(equals + 1);
        if (auto numbers = numbersOf(given.text)) given.numbers = std::move(*numbers);
        if (const auto done = set(request, given); !done) return done.error();
    }
    return checked(std::move(request));
}

Result<RiRequest> parseRequest(RtInt n, const RtToken* tokens, const RtPointer* values) {
    RiRequest request;
    for (RtInt i = 0; i < n; ++i) {
        if (!tokens[i] || !values[i]) continue;
        // "uniform float[2] shutter", or the bare name of one that was declared before.
        std::string_view token(tokens[i]);
        const std::size_t space = token.find_last_of(" \t");
        Given given{std::string(space == std::string_view::npos ? token : token.substr(space + 1))};
        // Those of the renderer itself.
        if (given.name.starts_with("__")) continue;
        const bool text = given.name == "package" || given.name == "overrides";
        const bool declared = space != std::string_view::npos;
        const bool whole = declared ? token.find("int") != std::string_view::npos
                                    : given.name == "part" || given.name == "parts" || given.name == "samples";
        if (text) {
            const char* value = *static_cast<const char* const*>(values[i]);
            if (value) given.text = value;
        } else if (whole && given.name != "shutter") {
            given.numbers = {static_cast<float>(*static_cast<const RtInt*>(values[i]))};
        } else {
            const auto* from = static_cast<const RtFloat*>(values[i]);
            given.numbers.assign(from, from + (given.name == "shutter" ? 2 : 1));
        }
        if (const auto done = set(request, given); !done) return done.error();
    }
    return checked(std::move(request));
}

RiWish wishOf(const RiRequest& request, const WhorlGroom& groom) {
    RiWish wish;
    wish.request = WHORL_REQUEST_INIT;
    wish.request.part = request.part.value_or(0);
    wish.request.part_count = request.part ? request.parts : 1;
    wish.request.share = request.share;
    // Renderers call from all of their threads.
    wish.request.flags = WHORL_ONE_THREAD;
    double framesPerSecond = double{request.framesPerSecond};
    if (!(framesPerSecond > 0.0) && !whorl_frames(&groom, nullptr, nullptr, &framesPerSecond)) framesPerSecond = 24.0;
    const auto seconds = [&](float offset) {
        return static_cast<float>((double{request.frame} + double{offset}) / framesPerSecond);
    };
    const bool moving = request.shutter && (*request.shutter)[0] < (*request.shutter)[1] && request.samples > 1 &&
                        whorl_is_animated(&groom) != 0;
    if (moving) {
        for (int i = 0; i < request.samples; ++i) {
            const float along = static_cast<float>(i) / static_cast<float>(request.samples - 1);
            const float offset = (*request.shutter)[0] + along * ((*request.shutter)[1] - (*request.shutter)[0]);
            wish.motionTimes.push_back(offset);
            wish.hairTimes.push_back(seconds(offset));
        }
    } else {
        wish.hairTimes.push_back(seconds(request.shutter ? (*request.shutter)[0] : 0.0f));
    }
    wish.request.times = wish.hairTimes.data();
    wish.request.time_count = static_cast<std::uint32_t>(wish.hairTimes.size());
    return wish;
}

struct SharedGroom::State {
    std::string package, overrides;
    std::mutex mutex;  ///< of what follows
    bool tried = false;
    WhorlGroom* groom = nullptr;
    WhorlStatus status = WHORL_OK;
    WhorlError error{};
};

SharedGroom::SharedGroom(std::unique_ptr<State> state) : m_state(std::move(state)) {}

SharedGroom::~SharedGroom() {
    whorl_close(m_state->groom);
}

std::shared_ptr<SharedGroom> SharedGroom::of(const RiRequest& request) {
    // Primitives come as text that is parsed one by one, so only here they can learn of each other. The one used last
    // stays, for interfaces that keep nothing from call to call.
    struct Known {
        std::mutex mutex;
        std::map<std::string, std::weak_ptr<SharedGroom>> grooms;
        std::shared_ptr<SharedGroom> last;
    };
    static Known known;
    namespace fs = std::filesystem;
    std::error_code fault;
    const fs::path manifest = fs::path(request.package) / "groom.json";
    const auto written = fs::last_write_time(fs::exists(manifest, fault) ? manifest : fs::path(request.package), fault);
    const std::string key = request.package + '\0' + request.overrides + '\0' +
                            std::to_string(fault ? 0 : written.time_since_epoch().count());
    // Let go of after the lock.
    std::shared_ptr<SharedGroom> before;
    const std::lock_guard lock(known.mutex);
    std::erase_if(known.grooms, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<SharedGroom>& place = known.grooms[key];
    std::shared_ptr<SharedGroom> shared = place.lock();
    if (!shared) {
        auto state = std::make_unique<State>();
        state->package = request.package;
        state->overrides = request.overrides;
        shared.reset(new SharedGroom(std::move(state)));
        place = shared;
    }
    before = std::exchange(known.last, shared);
    return shared;
}

const WhorlGroom* SharedGroom::get(WhorlStatus& status, WhorlError& error) {
    State& s = *m_state;
    const std::lock_guard lock(s.mutex);
    if (!s.tried) {
        s.status =
            whorl_open(s.package.c_str(), s.overrides.empty() ? nullptr : s.overrides.c_str(), &s.groom, &s.error);
        // Too little memory may pass.
        s.tried = s.status != WHORL_NO_MEMORY;
    }
    status = s.status;
    error = s.error;
    return s.groom;
}

}  // namespace whorl::procedural
