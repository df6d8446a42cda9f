// What the command line can say: the one source of --help.
#pragma once

#include "cli/bench_options.h"
#include "cli/compare_options.h"
#include "cli/dgp_options.h"
#include "cli/false_colour_options.h"
#include "cli/file_names.h"
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
    std::vector<std::string> scenes;      ///< of `render`, which makes options for each of them (forScene)
    std::string folder;                   ///< of files whose names have none; empty: the current one
    unsigned jobs = 1;                    ///< scenes that are rendered at once
    bool watch = false;                   ///< render again when a file of the scene changes
    bool strict = false;                  ///< warnings are errors
    std::string show;                     ///< "sixel", "kitty": the picture in the terminal; empty: not
    std::optional<std::string> tev;       ///< HOST:PORT of the viewer that the picture is sent to
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
    /// For one of `scenes`: names of files have no {scene} and {date} any more, nor {sensor} unless there are several.
    /// Throws InputError for patterns that cannot be filled.
    RenderOptions forScene(const std::string& one) const;
    /// For sensor number `index` of several: where a file's name does not say {sensor}, it ends with _0, _1 …
    RenderOptions forSensor(size_t index) const;
    /// With these parts in all names.
    RenderOptions named(const NameParts& parts) const;
    /// Of all files that are to be written, but checkpoints.
    std::vector<std::string> fileNames() const;
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
