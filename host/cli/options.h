// What the command line can say: the one source of --help.
#pragma once

#include "cli/bench_options.h"
#include "cli/compare_options.h"
#include "cli/dgp_options.h"
#include "cli/false_colour_options.h"
#include "cli/merge_options.h"
#include "cli/photometry_options.h"
#include "cli/report_options.h"
#include "output/png.h"
#include "view/live_view.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct RenderOptions : SceneOptions {
    std::string output, png, stats, grid; ///< paths; empty = not asked for
    bool daylightFactor = false;
    std::string checkpoint, resume;      ///< likewise
    double every = 60;                   ///< seconds between checkpoints
    std::string devices;                 ///< as --device has them; empty: one, chosen
    std::optional<double> answerSeconds; ///< of a device that shares passes
    StopRule stop;
    ExposureChoice exposure;
    bool isViewed = false; ///< by a page in the browser, as `view` says
    ViewOptions view;

    /// `output`, or the scene's stem with .exr in the current folder; empty where only the grid is asked for.
    std::string outputPath() const;
    /// For sensor number `index` of several: the files' names end with _0, _1 …
    RenderOptions forSensor(size_t index) const;
};

struct Options {
    RenderOptions render, view;
    SceneOptions info;
    CompareOptions compare;
    MergeOptions merge;
    PhotometryOptions photometry;
    FalseColourOptions falseColour;
    ReportOptions report;
    DgpOptions dgp;
    BenchOptions bench;
    bool devicesJson = false, doctorJson = false;
    std::string manualFolder;
};

/// Declares the commands and all their options, filled into `options` (which must outlive `app`) by app.parse().
void declareOptions(CLI::App& app, Options& options);

} // namespace quasilux
