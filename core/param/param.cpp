// SPDX-License-Identifier: Apache-2.0
#include "core/param/param.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace whorl {
namespace {

std::string numberText(double value) {
    // Parameters are floats: the shortest text that reads back to the same float.
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value));
    return {buffer, end.ptr};
}

std::optional<double> parseNumber(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    double value = 0.0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

/// "#c08040": sRGB as colour pickers write it.
std::optional<glm::vec3> parseHexColour(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    unsigned value = 0;
    const auto end = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
    if (end.ec != std::errc() || end.ptr != text.data() + 7) return std::nullopt;
    const auto linear = [](unsigned byte) {
        const double c = byte / 255.0;
        return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    };
    return glm::vec3(linear(value >> 16), linear((value >> 8) & 255u), linear(value & 255u));
}

std::optional<glm::vec3> parseVector(std::string_view text) {
    if (const auto colour = parseHexColour(text)) return colour;
    glm::vec3 result(0.0f);
    int count = 0;
    while (!text.empty()) {
        const std::size_t begin = text.find_first_not_of(" ,");
        if (begin == std::string_view::npos) break;
        text.remove_prefix(begin);
        const std::size_t length = std::min(text.find_first_of(" ,"), text.size());
        const auto number = parseNumber(text.substr(0, length));
        if (!number || count == 3) return std::nullopt;
        result[count++] = static_cast<float>(*number);
        text.remove_prefix(length);
    }
    if (count == 1) return glm::vec3(result.x);
    return count == 3 ? std::optional(result) : std::nullopt;
}

std::optional<double> asNumber(const ParamValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1.0 : 0.0;
    if (const auto* text = std::get_if<std::string>(&value)) return parseNumber(*text);
    return std::nullopt;
}

std::optional<glm::vec3> asVector(const ParamValue& value) {
    if (const auto* vector = std::get_if<glm::vec3>(&value)) return *vector;
    if (const auto* text = std::get_if<std::string>(&value)) return parseVector(*text);
    if (const auto number = asNumber(value)) return glm::vec3(static_cast<float>(*number));
    return std::nullopt;
}

std::optional<bool> asFlag(const ParamValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        if (*text == "on" || *text == "true" || *text == "yes" || *text == "1") return true;
        if (*text == "off" || *text == "false" || *text == "no" || *text == "0") return false;
        return std::nullopt;
    }
    if (const auto number = asNumber(value)) return *number != 0.0;
    return std::nullopt;
}

std::string subject(const ParamInfo& info) {
    return std::string(info.id);
}

Error wrongType(const ParamInfo& info, const char* what) {
    return {subject(info) + " takes " + what + "."};
}

Error outOfRange(const ParamInfo& info, double value) {
    return {subject(info) + " goes from " + numberText(info.min) + " to " + numberText(info.max) + "; " +
            (std::isnan(value) ? "not-a-number" : numberText(value)) + " is outside."};
}

bool inRange(const ParamInfo& info, double value) {
    // The limits of the declaration are doubles, values are floats: 0.1 must be inside 0 to 0.1.
    return value >= static_cast<double>(static_cast<float>(info.min)) - 1e-9 * std::abs(info.min) &&
           value <= static_cast<double>(static_cast<float>(info.max)) + 1e-6 * std::abs(info.max);
}

Result<void> setFloat(const ParamInfo& info, float& target, const ParamValue& value) {
    const auto number = asNumber(value);
    if (!number) return wrongType(info, "a number");
    if (!inRange(info, *number)) return outOfRange(info, *number);
    target = static_cast<float>(*number);
    return {};
}

Result<void> setVector(const ParamInfo& info, glm::vec3& target, const ParamValue& value, bool limited) {
    const auto vector = asVector(value);
    if (!vector) return wrongType(info, "one or three numbers, or a colour such as #c08040");
    for (int i = 0; i < 3; ++i) {
        const auto component = static_cast<double>((*vector)[i]);
        if (limited ? !inRange(info, component) : !(component >= 0.0 && component <= 1000.0)) {
            return outOfRange(info, component);
        }
    }
    target = *vector;
    return {};
}

struct Setter {
    const ParamInfo& info;
    const ParamValue& value;

    Result<void> operator()(bool* target) const {
        const auto flag = asFlag(value);
        if (!flag) return wrongType(info, "on or off");
        *target = *flag;
        return {};
    }
    Result<void> operator()(int* target) const {
        const auto number = asNumber(value);
        if (!number || std::floor(*number) != *number) return wrongType(info, "a whole number");
        if (!inRange(info, *number)) return outOfRange(info, *number);
        *target = static_cast<int>(*number);
        return {};
    }
    Result<void> operator()(float* target) const { return setFloat(info, *target, value); }
    Result<void> operator()(Driven* target) const { return setFloat(info, target->value, value); }
    Result<void> operator()(DrivenVector* target) const { return setVector(info, target->value, value, true); }
    Result<void> operator()(DrivenColour* target) const { return setVector(info, target->value, value, false); }
    Result<void> operator()(Colour* target) const { return setVector(info, target->value, value, false); }
    Result<void> operator()(Vector* target) const { return setVector(info, target->value, value, true); }
    Result<void> operator()(MapName* target) const {
        const auto* text = std::get_if<std::string>(&value);
        if (!text) return wrongType(info, "the name of a map");
        target->name = *text;
        return {};
    }
    Result<void> operator()(Choice* target) const {
        std::string names;
        const auto* text = std::get_if<std::string>(&value);
        for (std::size_t i = 0; i < info.choices.size(); ++i) {
            if (text && info.choices[i] == *text) {
                target->index = static_cast<int>(i);
                return {};
            }
            names += (i > 0 ? ", " : "") + std::string(info.choices[i]);
        }
        if (const auto number = asNumber(value)) {
            if (*number >= 0.0 && *number < static_cast<double>(info.choices.size()) &&
                std::floor(*number) == *number) {
                target->index = static_cast<int>(*number);
                return {};
            }
        }
        return Error{subject(info) + " is one of: " + names + "."};
    }
};

}  // namespace

ParamValue paramValue(const ParamRef& param) {
    struct Getter {
        const ParamInfo& info;
        ParamValue operator()(const bool* v) const { return *v; }
        ParamValue operator()(const int* v) const { return static_cast<double>(*v); }
        ParamValue operator()(const float* v) const { return static_cast<double>(*v); }
        ParamValue operator()(const Driven* v) const { return static_cast<double>(v->value); }
        ParamValue operator()(const DrivenVector* v) const { return v->value; }
        ParamValue operator()(const DrivenColour* v) const { return v->value; }
        ParamValue operator()(const Colour* v) const { return v->value; }
        ParamValue operator()(const Vector* v) const { return v->value; }
        ParamValue operator()(const MapName* v) const { return v->name; }
        ParamValue operator()(const Choice* v) const {
            const auto index = static_cast<std::size_t>(v->index);
            return std::string(index < info.choices.size() ? info.choices[index] : std::string_view());
        }
    };
    return std::visit(Getter{param.info}, param.target);
}

Result<void> setParamValue(const ParamRef& param, const ParamValue& value) {
    return std::visit(Setter{param.info, value}, param.target);
}

std::string* paramMap(const ParamRef& param) {
    if (const auto* v = std::get_if<Driven*>(&param.target)) return &(*v)->map;
    if (const auto* v = std::get_if<DrivenVector*>(&param.target)) return &(*v)->map;
    if (const auto* v = std::get_if<DrivenColour*>(&param.target)) return &(*v)->map;
    if (const auto* v = std::get_if<MapName*>(&param.target)) return &(*v)->name;
    return nullptr;
}

bool isDriven(const ParamRef& param) {
    return std::holds_alternative<Driven*>(param.target) || std::holds_alternative<DrivenVector*>(param.target) ||
           std::holds_alternative<DrivenColour*>(param.target);
}

void scaleLengths(std::span<const ParamRef> params, float factor) {
    for (const ParamRef& param : params) {
        const bool length = param.info.unit == "mm";
        if (!length && param.info.unit != "per metre") continue;
        const auto scaled = [&](float value) {
            const float wanted = length ? value * factor : value / factor;
            const auto least = static_cast<float>(param.info.min), most = static_cast<float>(param.info.max);
            return std::isfinite(wanted) ? std::clamp(wanted, least, most) : value;
        };
        if (auto* const* number = std::get_if<float*>(&param.target)) **number = scaled(**number);
        if (auto* const* driven = std::get_if<Driven*>(&param.target)) (*driven)->value = scaled((*driven)->value);
        if (auto* const* vector = std::get_if<DrivenVector*>(&param.target)) {
            for (int axis = 0; axis < 3; ++axis) (*vector)->value[axis] = scaled((*vector)->value[axis]);
        }
    }
}

std::string paramText(const ParamValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
    if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
    if (const auto* v = std::get_if<glm::vec3>(&value)) {
        return numberText(static_cast<double>(v->x)) + " " + numberText(static_cast<double>(v->y)) + " " +
               numberText(static_cast<double>(v->z));
    }
    return std::get<std::string>(value);
}

}  // namespace whorl
