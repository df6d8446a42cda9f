// Options of `quasilux photometry`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace quasilux {

struct PhotometryOptions {
    std::string file;
    std::string svg; ///< path; empty = not asked for
    unsigned lampSet = 1;
    bool json = false, quiet = false;
};

void declarePhotometry(CLI::App& app, PhotometryOptions& options);

} // namespace quasilux
