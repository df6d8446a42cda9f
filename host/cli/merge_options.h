// Options of `quasilux merge`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace quasilux {

struct MergeOptions {
    std::vector<std::string> parts;      ///< checkpoints
    std::string output, png, checkpoint; ///< paths; empty = not asked for
    bool json = false, quiet = false;
};

void declareMerge(CLI::App& app, MergeOptions& options);

} // namespace quasilux
