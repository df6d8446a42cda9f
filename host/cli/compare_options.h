// Options of `quasilux compare`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

struct CompareOptions {
    std::string image, reference, mask, referenceStandardError, scale, html; ///< paths; empty = not given
    std::vector<std::string> regions;                                        ///< "NAME=VALUE,VALUE..."
    std::vector<std::string> referenceNoise;                                 ///< "X" or "NAME=X"
    bool netOfImageNoise = false;
    std::optional<double> maximumRelMse, maximumRmse, maximumBias;
    uint64_t maximumNonFinite = 0, worstPixels = 5;
    bool json = false, quiet = false;
};

void declareCompare(CLI::App& app, CompareOptions& options);

} // namespace quasilux
