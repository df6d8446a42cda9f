// What `quasilux bench` can be told.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct BenchOptions {
    std::vector<std::string> scenes, methods, definitions;
    std::vector<std::string> references; ///< one for each scene, or none; "-" = none for this one
    std::vector<double> referenceNoise;  ///< one for each reference, or none
    std::vector<int> devices;            ///< empty = the default one
    double seconds = 10;
    std::optional<std::string> micro; ///< parts of micro-benchmarks, as parseMicroParts takes them
    std::string output, html;         ///< paths; empty = not asked for
    bool json = false, quiet = false;
};

void declareBench(CLI::App& app, BenchOptions& options);

} // namespace quasilux
