// Man pages and completions of shells, from the declarations that --help is made of.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace quasilux {

/// quasilux(1): the commands.
std::string manualPage(CLI::App& program);
/// quasilux-render(1) …: one command with its options.
std::string manualPageOf(CLI::App& command);

std::string bashCompletion(CLI::App& program);
std::string zshCompletion(CLI::App& program);
std::string fishCompletion(CLI::App& program);

} // namespace quasilux
