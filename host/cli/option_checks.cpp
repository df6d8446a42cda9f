// Validators for CLI11: each returns an empty text, or what is wrong and what was expected.
#include "cli/option_checks.h"

#include "device/device_choice.h"
#include "scene/load_limits.h"
#include "scene/quasi_specular.h"
#include "util/nearest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace quasilux {

namespace {

/// The whole text as a number, or nothing. from_chars takes no locale, no blanks and no plus sign.
template <typename T>
std::optional<T> parseAll(const std::string& text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stopped, status] = std::from_chars(text.data(), end, value);
    return status == std::errc() && stopped == end ? std::optional<T>(value) : std::nullopt;
}

CLI::Validator number(const std::string& expected, const std::function<bool(double)>& allowed) {
    return CLI::Validator(
        [=](const std::string& text) {
            const auto value = parseAll<double>(text);
            return value && allowed(*value) ? std::string() : fmt::format("'{}' given, expected {}", text, expected);
        },
        "");
}

/// What is wrong with "level:NUMBER"; empty if nothing.
std::string levelError(const std::string& text) {
    try {
        parsePhaseLevel(text, {});
    } catch (const InputError& error) {
        return fmt::format("'{}' given: {}", text, error.what());
    }
    return {};
}

} // namespace

CLI::Validator wholeNumber(uint64_t from, uint64_t to) {
    return CLI::Validator(
        [=](std::string& text) {
            const auto value = parseAll<uint64_t>(text);
            if (value && *value >= from && *value <= to) {
                text = std::to_string(*value);
                return std::string();
            }
            return fmt::format("'{}' given, expected a whole number from {} to {}", text, from, to);
        },
        "");
}

CLI::Validator passRange(uint64_t to) {
    return CLI::Validator(
        [=](const std::string& text) {
            const auto colon = text.find(':');
            const auto first = colon == std::string::npos ? 0 : parseAll<uint64_t>(text.substr(0, colon));
            const auto end = parseAll<uint64_t>(colon == std::string::npos ? text : text.substr(colon + 1));
            if (first && end && *first < *end && *end <= to) return std::string();
            return fmt::format("'{}' given, expected a whole number from 1 to {}, or two, A:B, the first pass and the "
                               "one after the last",
                               text, to);
        },
        "");
}

CLI::Validator numberAbove(double above, double to) {
    return number(fmt::format("a number above {:g} and up to {:g}", above, to),
                  [=](double value) { return value > above && value <= to; });
}

CLI::Validator numberBetween(double from, double to) {
    return number(fmt::format("a number from {:g} to {:g}", from, to),
                  [=](double value) { return value >= from && value <= to; });
}

CLI::Validator numberRange() {
    return CLI::Validator(
        [](const std::string& text) {
            const auto colon = text.find(':');
            const auto from = colon == std::string::npos ? std::nullopt : parseAll<double>(text.substr(0, colon)),
                       to = colon == std::string::npos ? std::nullopt : parseAll<double>(text.substr(colon + 1));
            if (from && to && std::isfinite(*from) && std::isfinite(*to) && *from < *to) return std::string();
            return fmt::format("'{}' given, expected two numbers A:B, the first below the second", text);
        },
        "");
}

bool isHostAndPort(const std::string& text) {
    const auto colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0 || text.find('/') != std::string::npos) return false;
    const auto port = parseAll<unsigned>(text.substr(colon + 1));
    return port && *port >= 1 && *port <= 65535;
}

CLI::Validator hostAndPort() {
    return CLI::Validator(
        [](const std::string& text) {
            return isHostAndPort(text) ? std::string()
                                       : fmt::format("'{}' given, expected HOST:PORT, as 127.0.0.1:14158", text);
        },
        "");
}

CLI::Validator oneOf(std::vector<std::string> names) {
    const std::string known = fmt::format("{}", fmt::join(names, "|")); // no other validator has a name
    return CLI::Validator(
        [names = std::move(names)](const std::string& text) {
            if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
            return fmt::format("unknown value '{}', {}", text, expectedNames(text, names));
        },
        "", known);
}

CLI::Option* optionOf(CLI::App& command, const std::string& name) {
    for (CLI::Option* option : command.get_options())
        if (option->check_name(name)) return option;
    throw std::logic_error("no option " + name);
}

std::vector<std::string> choicesOf(CLI::Option& option) {
    std::string names;
    try {
        for (int index = 0; names.empty(); ++index) names = option.get_validator(index)->get_name();
    } catch (const CLI::OptionNotFound&) { // there is no further one
        return {};
    }
    return CLI::detail::split(names, '|');
}

CLI::Validator deviceList() {
    return CLI::Validator(
        [](const std::string& text) {
            if (parseDeviceList(text)) return std::string();
            return fmt::format("'{}' given, expected numbers from 0 to 1000 with commas between, each with /PARTS or "
                               "not, or all",
                               text);
        },
        "");
}

CLI::Validator definition() {
    return CLI::Validator(
        [](const std::string& text) {
            const auto equals = text.find('=');
            if (equals != std::string::npos && equals > 0) return std::string();
            return fmt::format("'{}' given, expected name=value", text);
        },
        "");
}

CLI::Validator loadLimit() {
    return CLI::Validator(
        [](const std::string& text) {
            const auto equals = std::min(text.find('='), text.size());
            std::vector<std::string> names;
            names.reserve(std::size(namedLimits));
            for (const NamedLimit& limit : namedLimits) names.emplace_back(limit.name);
            const std::string name = text.substr(0, equals);
            if (std::find(names.begin(), names.end(), name) == names.end())
                return fmt::format("'{}' given: unknown limit '{}', {}", text, name, expectedNames(name, names));
            const auto value = parseAll<uint64_t>(equals < text.size() ? text.substr(equals + 1) : "");
            constexpr uint64_t most = 1000000000000;
            if (value && *value >= 1 && *value <= most) return std::string();
            return fmt::format("'{}' given, expected {}=N, a whole number from 1 to {}", text, name, most);
        },
        "");
}

CLI::Validator quasiSpecularList() {
    return CLI::Validator(
        [](const std::string& text) {
            if (isPhaseLevel(text)) return levelError(text);
            std::istringstream items(text + ',');
            std::string item;
            bool complete = !text.empty();
            size_t count = 0, words = 0;
            while (std::getline(items, item, ',')) {
                complete = complete && !item.empty();
                ++count;
                words += item == "auto" || item == "none" || item == "all" || isPhaseLevel(item);
            }
            if (complete && (words == 0 || count == 1)) return std::string();
            return fmt::format("'{}' given, expected auto, none, all or ids of bsdfs and media with commas between, or "
                               "level:NUMBER",
                               text);
        },
        "");
}

std::vector<std::pair<std::string, std::string>> parseDefinitions(const std::vector<std::string>& texts) {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto& text : texts) {
        const auto equals = text.find('=');
        pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return pairs;
}

} // namespace quasilux
