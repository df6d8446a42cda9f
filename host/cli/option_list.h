// The declared options as a list, for man pages and completions.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace quasilux {

struct ListedOption {
    std::vector<std::string> names; ///< "-o", "--output"; of a positional one: "SCENE"
    bool isPositional = false;
    std::string value;                ///< "FILE"; empty: it takes none
    std::vector<std::string> choices; ///< that the value is one of; empty: anything
    std::string description, group;

    bool takesFile() const { return value == "FILE" || value == "FOLDER"; }
};

/// In the order of their declaration, groups together in the order of their first.
std::vector<ListedOption> listedOptions(CLI::App& command);

/// The commands of the program.
std::vector<CLI::App*> listedCommands(CLI::App& program);

} // namespace quasilux
