// Checks of options whose messages say what was expected.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

/// For Option::transform: it takes leading zeros away, with which CLI11 would read an octal number.
CLI::Validator wholeNumber(uint64_t from, uint64_t to);
/// "N", a count of passes, or "A:B", the passes A to B - 1; B up to `to`.
CLI::Validator passRange(uint64_t to);
/// `above` itself is refused.
CLI::Validator numberAbove(double above, double to);
CLI::Validator numberBetween(double from, double to);
/// "A:B", two finite numbers, A below B.
CLI::Validator numberRange();
/// "HOST:PORT"; of an IPv6 address "[ADDRESS]:PORT".
CLI::Validator hostAndPort();
/// Whether it is such.
bool isHostAndPort(const std::string& text);
CLI::Validator oneOf(std::vector<std::string> names);
/// The names of that one; empty for an option without it.
std::vector<std::string> choicesOf(CLI::Option& option);
/// The option of this name, which there must be. (App::get_option ends the program where memory fails.)
CLI::Option* optionOf(CLI::App& command, const std::string& name);
/// parseDeviceList() knows it.
CLI::Validator deviceList();
/// "name=value" with a name.
CLI::Validator definition();
/// Names and values of such.
std::vector<std::pair<std::string, std::string>> parseDefinitions(const std::vector<std::string>& texts);
/// "name=number" with the name of a limit on scenes (host/scene/load_limits.h).
CLI::Validator loadLimit();
/// "auto", "none", "all", "level:NUMBER" or a comma-separated list without empty items.
CLI::Validator quasiSpecularList();

} // namespace quasilux
