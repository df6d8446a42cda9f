// Options of `quasilux bench`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct BenchOptions {
    std::vector<std::string> scenes, methods, definitions;
    bool lenient = false;
    std::vector<std::string> references; ///< one for each scene, or none; "-" = none for this one
    std::vector<double> referenceNoise;  ///< one for each reference, or none
    std::vector<int> devices;            ///< empty = the default one
    double seconds = 10;
    std::vector<std::string> growth; ///< subjects, "threads" among them
    unsigned growthSteps = 100;      ///< of each subject, from the least one on
    bool compareDevices = false, compareKernels = false, passTimes = false;
    std::optional<std::string> micro; ///< parts of micro-benchmarks, as parseMicroParts takes them
    std::string output, html;         ///< paths; empty = not asked for
    bool json = false, quiet = false;

    /// Whether a part besides error over time is asked for.
    bool hasParts() const { return micro || !growth.empty() || compareDevices || compareKernels || passTimes; }
};

void declareBench(CLI::App& app, BenchOptions& options);

} // namespace quasilux
