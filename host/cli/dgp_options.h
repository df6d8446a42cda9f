// Options of `quasilux dgp`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace quasilux {

struct DgpOptions {
    std::string input;
    std::optional<std::string> projection; ///< both: else what the image's header says
    std::optional<double> degrees;         ///< that the image is wide
    double threshold = 2000;               ///< cd/m²
    std::optional<double> illuminance, efficacy;
    bool photometric = false, json = false, quiet = false;
};

void declareDgp(CLI::App& app, DgpOptions& options);

} // namespace quasilux
