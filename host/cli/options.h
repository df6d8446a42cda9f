// What the command line can say: the one source of --help.
#pragma once

#include "auto/freedom.h"
#include "cli/bench_options.h"
#include "cli/compare_options.h"
#include "cli/false_colour_options.h"
#include "cli/merge_options.h"
#include "cli/photometry_options.h"
#include "output/png.h"
#include "render/settings.h"
#include "view/live_view.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

/// What render and info share: a scene, the device, and settings that override those of the scene.
struct SceneOptions {
    std::string scene;
    std::string sensor;                   ///< its number or id; empty: the first one; render: or "all"
    std::vector<std::string> definitions; ///< "name=value"
    bool lenient = false;                 ///< what the scene says and is not known is left out
    std::optional<unsigned> bdd, photons, cameraPaths;
    std::optional<uint64_t> seed;
    std::optional<std::string> variant, direct, map, emission, quasiSpecular, radius;
    std::optional<double> radiusScale;
    bool energyBalance = false;
    bool autoAll = false, fixed = false;
    std::string kernels = "scene";
    int device = -1;
    unsigned workGroupSize = 64;
    uint64_t deviceMemory = 0;        ///< bytes; 0: what the device has
    std::vector<std::string> without; ///< "components", "bias"
    bool json = false, quiet = false;

    /// `definitions` as loadScene takes them.
    std::vector<std::pair<std::string, std::string>> parameters() const;
    Unknown unknown() const { return lenient ? Unknown::forgiven : Unknown::refused; }
    LoadChoice choice() const { return {sensor, unknown()}; }
    /// The scene's settings, overridden by what was given here. Throws InputError.
    RenderSettings settings(const Scene& loaded) const;
    /// What is left to a search.
    Freedom freedom(const Scene& loaded) const;
};

struct RenderOptions : SceneOptions {
    std::string output, png, stats, grid; ///< paths; empty = not asked for
    bool daylightFactor = false;
    std::string checkpoint, resume; ///< likewise
    double every = 60;              ///< seconds between checkpoints
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
    BenchOptions bench;
    bool devicesJson = false;
};

/// Declares the commands and all their options, filled into `options` (which must outlive `app`) by app.parse().
void declareOptions(CLI::App& app, Options& options);

} // namespace quasilux
