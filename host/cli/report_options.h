// Options of `quasilux report`.
#pragma once

#include "cli/scene_options.h"

namespace quasilux {

struct ReportOptions : SceneOptions {
    std::string output;
    double seconds = 60;
    double precision = 0.01;
};

void declareReport(CLI::App& app, ReportOptions& options);

} // namespace quasilux
