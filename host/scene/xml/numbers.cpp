// Strict number parsing, independent of the locale.
#include "scene/xml/numbers.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Parses all of `text`; a leading plus sign is allowed.
template <typename T>
std::errc parseAll(std::string_view text, T& value) {
    text = trim(text);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return error;
    return end == text.data() + text.size() ? std::errc{} : std::errc::invalid_argument;
}

} // namespace

std::vector<std::string_view> splitList(std::string_view text) {
    std::vector<std::string_view> pieces;
    size_t begin = 0;
    while ((begin = text.find_first_not_of(", \t\r\n", begin)) != std::string_view::npos) {
        const size_t end = std::min(text.find_first_of(", \t\r\n", begin), text.size());
        pieces.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return pieces;
}

double parseNumber(std::string_view text, const SourceLocation& where, std::string_view what) {
    double value = 0;
    const std::errc error = parseAll(text, value);
    if (error == std::errc::result_out_of_range)
        throw InputError(where, fmt::format("{}: '{}' is out of the range of a double.", what, text));
    if (error != std::errc{}) throw InputError(where, fmt::format("{}: '{}' is not a number.", what, text));
    if (!std::isfinite(value))
        throw InputError(where, fmt::format("{}: '{}' is not finite; give a finite number.", what, text));
    return value;
}

std::vector<double> parseNumbers(std::string_view text, const SourceLocation& where, std::string_view what) {
    std::vector<double> values;
    for (std::string_view piece : splitList(text)) values.push_back(parseNumber(piece, where, what));
    return values;
}

int64_t parseInteger(std::string_view text, const SourceLocation& where, std::string_view what) {
    int64_t value = 0;
    if (parseAll(text, value) != std::errc{})
        throw InputError(where, fmt::format("{}: '{}' is not an integer of 64 bits.", what, text));
    return value;
}

uint64_t parseUnsigned(std::string_view text, uint64_t lowest, uint64_t highest, const SourceLocation& where,
                       std::string_view what) {
    uint64_t value = 0;
    if (parseAll(text, value) != std::errc{} || value < lowest || value > highest)
        throw InputError(where, fmt::format("{}: '{}' is not an integer from {} to {}.", what, text, lowest, highest));
    return value;
}

} // namespace quasilux
