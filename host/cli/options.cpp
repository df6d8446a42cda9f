// Declares every option with its unit, default and range, and turns the values into settings.
#include "cli/options.h"

#include "cli/option_checks.h"
#include "cli/scene_options.h"

#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr uint64_t maximumPasses = 1000000000;

void declareFiles(CLI::App& command, RenderOptions& options) {
    const char* group = "Files ({scene}, {sensor}, {date}, {seed} and {passes} in their names stand for these)";
    command
        .add_option("-o,--output", options.output,
                    "OpenEXR image with all layers, .exr (default: the scene's name with .exr)")
        ->type_name("FILE")
        ->group(group);
    auto* png = command.add_option("--png", options.png, "Tone-mapped 8-bit sRGB picture, .png (default: none)")
                    ->type_name("FILE")
                    ->group(group);
    command
        .add_option("--grid", options.grid,
                    "Measures the scene's illuminance-grid instead of rendering its sensor's image; a table, .csv. "
                    "An image is written only if --output is given (default: none)")
        ->type_name("FILE")
        ->group(group);
    command
        .add_flag("--daylight-factor", options.daylightFactor,
                  "Of a grid or irradiancemeter also the share of the sky's illuminance of free ground, without the "
                  "sun and lamps (default: off)")
        ->group(group);
    command.add_option("--stats", options.stats, "Statistics, .json (default: none)")->type_name("FILE")->group(group);
    command
        .add_option("--folder", options.folder,
                    "Where files go whose names have no folder (default: what the environment variable "
                    "QUASILUX_OUTPUT says, else the current folder)")
        ->envname("QUASILUX_OUTPUT")
        ->type_name("FOLDER")
        ->group(group);
    auto* stops = command
                      .add_option("--exposure", options.exposure.stops,
                                  "Exposure of the PNG in stops relative to the automatic one (default: 0)")
                      ->type_name("STOPS")
                      ->check(numberBetween(-60, 60))
                      ->group(group)
                      ->needs(png);
    command
        .add_option("--exposure-scale", options.exposure.scale,
                    "Exposure of the PNG as a factor on radiance, per W sr^-1 m^-2, with plain clamping (default: "
                    "automatic)")
        ->type_name("X")
        ->check(numberAbove(0, 1e30))
        ->group(group)
        ->needs(png)
        ->excludes(stops);
}

void declareScenes(CLI::App& command, RenderOptions& options) {
    command.add_option("SCENE", options.scenes, "Scene files, Mitsuba 3 XML or glTF 2.0")
        ->required()
        ->type_name("FILE");
    command
        .add_option("-j,--jobs", options.jobs,
                    "Scenes that are rendered at once, each by a process of its own (default: 1, one after the other)")
        ->type_name("N")
        ->transform(wholeNumber(1, 1000));
    command.add_flag("--watch", options.watch,
                     "Render again whenever the scene or a file that it was read from changes (default: off)");
}

void declareTerminal(CLI::App& command, RenderOptions& options) {
    command.add_flag("--strict", options.strict,
                     "Warnings are errors: what is known before the first pass ends the program before it, with exit "
                     "code 2 (default: off)");
    command
        .add_option("--show", options.show,
                    "Show the finished picture in the terminal, by what that understands: sixel or kitty (default: "
                    "not)")
        ->type_name("NAME")
        ->check(oneOf({"sixel", "kitty"}));
}

void declareTev(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--tev", options.tev,
                    "Send the picture to the viewer tev as it converges; HOST:PORT is where tev runs, or left out "
                    "(default: off; of HOST:PORT 127.0.0.1:14158)")
        ->type_name("HOST:PORT")
        ->check(hostAndPort())
        ->group("Live view");
}

// What has one terminal or one page for itself.
void excludeEachOther(CLI::App& render) {
    for (const char* name : {"--watch", "--view", "--show", "--resume"})
        optionOf(render, "--jobs")->excludes(optionOf(render, name));
    // A checkpoint is of one render, and that of the scene before would be in the way of the next.
    for (const char* name : {"--view", "--resume", "--checkpoint"})
        optionOf(render, "--watch")->excludes(optionOf(render, name));
    optionOf(render, "--show")->excludes(optionOf(render, "--json"));
}

void declareCheckpoints(CLI::App& command, RenderOptions& options) {
    const char* group = "Checkpoints";
    auto* checkpoint =
        command
            .add_option("--checkpoint", options.checkpoint,
                        "Where the render is kept as far as it has come, .ckpt; the one before is kept beside it "
                        "(default: none)")
            ->type_name("FILE")
            ->group(group);
    command
        .add_option("--every", options.every, "Time between checkpoints, in seconds; 0: after each pass (default: 60)")
        ->type_name("SECONDS")
        ->check(numberBetween(0, 1e9))
        ->group(group)
        ->needs(checkpoint);
    command
        .add_option("--resume", options.resume,
                    "Checkpoint to go on from, with the scene and options that it was begun with; stop rules may be "
                    "others (default: none)")
        ->type_name("FILE")
        ->group(group);
}

// Of one image; other commands take one device.
void declareDevices(CLI::App& command, RenderOptions& options) {
    command.remove_option(optionOf(command, "--device"));
    const char* group = "Device";
    command
        .add_option("--device", options.devices,
                    "Device numbers, as `quasilux devices` lists them, with commas between, or all: these share the "
                    "passes; N/PARTS divides device N into equal parts (default: the first GPU, else the first device)")
        ->type_name("LIST")
        ->check(deviceList())
        ->group(group);
    command
        .add_option("--device-timeout", options.answerSeconds,
                    "Seconds without the end of a pass after which one of several devices is dropped, though never "
                    "before ten times its longest pass (default: 600)")
        ->type_name("SECONDS")
        ->check(numberAbove(0, 1e9))
        ->group(group);
}

void declareView(CLI::App& command, RenderOptions& render) {
    ViewOptions& options = render.view;
    const char* group = "Live view";
    command
        .add_option("--listen", options.listen,
                    "Address that the page is served on, of this computer; others than loopback ones can be reached by "
                    "whoever is "
                    "in the network and has the page's address (default: 127.0.0.1)")
        ->type_name("ADDRESS")
        ->group(group);
    command.add_option("--port", options.port, "Port of the page, a number; 0: any that is free (default: 0)")
        ->type_name("N")
        ->transform(wholeNumber(0, 65535))
        ->group(group);
    command
        .add_flag_callback(
            "--no-browser", [&options] { options.opensBrowser = false; },
            "Print the page's address, but do not open it (default: opened where there is a desktop)")
        ->group(group);
}

void setPasses(const std::string& text, StopRule& stop) {
    const auto colon = text.find(':');
    stop.firstPass = colon == std::string::npos ? 0 : static_cast<unsigned>(std::stoul(text.substr(0, colon)));
    stop.passes = static_cast<unsigned>(std::stoul(colon == std::string::npos ? text : text.substr(colon + 1)));
}

void declareStop(CLI::App& command, StopRule& stop, const std::string& defaultTime) {
    const char* group = "Stop rules (the first one reached ends the render)";
    command.add_option("--time", stop.seconds, "Time to render, in seconds (default: " + defaultTime + ")")
        ->type_name("SECONDS")
        ->check(numberAbove(0, 1e9))
        ->group(group);
    command
        .add_option_function<std::string>(
            "--passes", [&stop](const std::string& text) { setPasses(text, stop); },
            "Passes to render, a count, or A:B for the passes numbered A to B - 1, whose checkpoint can be merged with "
            "those of others (default: no limit)")
        ->type_name("N|A:B")
        ->check(passRange(maximumPasses))
        ->group(group);
    command
        .add_option("--error", stop.relativeError,
                    "Estimated relative error to reach, noise and bias together, as a ratio: 0.01 is 1 % (default: no "
                    "limit)")
        ->type_name("RATIO")
        ->check(numberAbove(0, 1))
        ->group(group);
}

} // namespace

std::vector<std::pair<std::string, std::string>> SceneOptions::parameters() const {
    return parseDefinitions(definitions);
}

RenderSettings SceneOptions::settings(const Scene& loaded) const {
    RenderSettings result = settingsFromScene(loaded);
    if (bdd) result.bdd = *bdd;
    if (variant) result.variant = parseChoice<Variant>(*variant);
    if (direct) result.direct = parseChoice<DirectLight>(*direct);
    if (caustics) result.caustics = parseChoice<CausticLight>(*caustics);
    if (map) result.map = parseChoice<MapOrder>(*map);
    if (emission) result.emission = parseChoice<Emission>(*emission);
    if (photons) result.photonsPerPass = *photons;
    if (cameraPaths) result.cameraPaths = *cameraPaths;
    const bool isMeter = loaded.sensor.meter != MeterKind::none;
    if (result.cameraPaths > 1 && !mayHaveCameraPaths(isMeter, result))
        throw InputError(fmt::format(
            "{} camera paths of a pixel are asked for, by --camera-paths or the scene's camera-paths; meters and "
            "--map camera have their own number, leave it out",
            result.cameraPaths));
    if (cameraSampling) result.cameraSampling = parseChoice<CameraSampling>(*cameraSampling);
    if (result.cameraSampling == CameraSampling::adaptive && !mayHaveCameraPaths(isMeter, result))
        throw InputError(
            "camera sampling is to be adaptive, by --camera-sampling or the scene's camera-sampling; meters "
            "and --map camera sample evenly, leave it out");
    if (seed) result.seed = *seed;
    if (quasiSpecular) {
        result.quasiSpecular = *quasiSpecular;
        result.quasiSpecularOverridesScene = true;
    }
    if (radius) result.radius = parseChoice<RadiusChoice>(*radius);
    if (radiusScale) result.radiusScale = *radiusScale;
    result.energyBalance = energyBalance;
    result.genericKernels = kernels == "generic";
    if (!without.empty() && isMeter)
        throw InputError("readings of meters and grids say all that there is: --without is of images, leave it out");
    for (const auto& part : without) (part == "bias" ? result.film.bias : result.film.components) = false;
    return result;
}

Freedom SceneOptions::freedom(const Scene& loaded) const {
    const AutoMode mode = fixed ? AutoMode::off : autoAll ? AutoMode::all : AutoMode::open;
    Freedom freedom = freedomOf(loaded, mode);
    freedom.bdd &= !bdd;
    freedom.split &= !quasiSpecular;
    freedom.variant &= !variant;
    freedom.photons &= !photons;
    freedom.caustics &= !caustics;
    freedom.cameraPaths &= !cameraPaths;
    freedom.cameraSampling &= !cameraPaths && !cameraSampling;
    freedom.radius &= !radiusScale;
    return freedom;
}

std::string RenderOptions::outputPath() const {
    if (output.empty() && !grid.empty()) return {};
    return output.empty() ? std::filesystem::path(scene).stem().string() + ".exr" : output;
}

RenderOptions RenderOptions::forScene(const std::string& path) const {
    checkNamePattern(output, "--output");
    checkNamePattern(png, "--png");
    checkNamePattern(grid, "--grid");
    checkNamePattern(stats, "--stats");
    checkNamePattern(checkpoint, "--checkpoint", NameNeeded::beforeLoading);
    RenderOptions one = *this;
    one.scene = path;
    one.output = one.outputPath();
    NameParts parts = namePartsOf(path);
    if (sensor != "all") parts["sensor"] = sensor.empty() ? "0" : sensor;
    one = one.named(parts);
    for (std::string* file : {&one.output, &one.png, &one.grid, &one.stats}) *file = inFolder(folder, *file);
    return one;
}

RenderOptions RenderOptions::forSensor(size_t index) const {
    RenderOptions one = *this;
    one.sensor = std::to_string(index);
    one.output = outputPath();
    for (std::string* file : {&one.output, &one.png, &one.stats, &one.checkpoint}) {
        if (file->empty() || hasPlace(*file, "sensor")) continue;
        const std::filesystem::path name(*file);
        *file = (name.parent_path() / (name.stem().string() + "_" + one.sensor + name.extension().string())).string();
    }
    return one.named({{"sensor", one.sensor}});
}

RenderOptions RenderOptions::named(const NameParts& parts) const {
    RenderOptions filled = *this;
    for (std::string* file : {&filled.output, &filled.png, &filled.grid, &filled.stats, &filled.checkpoint})
        *file = fillName(*file, parts);
    return filled;
}

std::vector<std::string> RenderOptions::fileNames() const {
    std::vector<std::string> names;
    for (const std::string& name : {outputPath(), png, grid, stats})
        if (!name.empty()) names.push_back(name);
    return names;
}

namespace {

void declareRenderCommand(CLI::App& app, RenderOptions& options) {
    CLI::App& render = *app.add_subcommand("render", "Render scenes to OpenEXR images");
    declareScenes(render, options);
    declareScene(render, options, ", or all, one after the other, into files NAME_0.exr, NAME_1.exr ...");
    declareFiles(render, options);
    declareTerminal(render, options);
    declareStop(render, options.stop, "30 if no stop rule is given");
    declareCheckpoints(render, options);
    declareSettings(render, options);
    declareDevice(render, options);
    declareDevices(render, options);
    auto* viewed = render
                       .add_flag("--view", options.isViewed,
                                 "Serve a page that shows the picture as it converges, and open it (default: off)")
                       ->group("Live view");
    declareView(render, options);
    declareTev(render, options);
    excludeEachOther(render);
    for (const char* name : {"--listen", "--port", "--no-browser"}) optionOf(render, name)->needs(viewed);
}

void declareViewCommand(CLI::App& app, RenderOptions& options) {
    CLI::App& view =
        *app.add_subcommand("view", "Render a scene in the browser: look, move the camera, change the method");
    declareSceneFile(view, options);
    declareScene(view, options, "");
    declareView(view, options);
    declareStop(view, options.stop, "none; 600 with --auto if no stop rule is given");
    declareSettings(view, options);
    declareDevice(view, options);
    for (const char* ofFiles : {"--json", "--energy-balance"}) view.remove_option(optionOf(view, ofFiles));
    optionOf(view, "--quiet")
        ->description("No progress and no warnings on the terminal; errors are still printed (default: off)");
    optionOf(view, "--auto")
        ->description("Search the settings first, once, as render does; only then there is a picture (default: off)");
    optionOf(view, "--fixed")->description("Search nothing (default: on, but for --auto)");
}

} // namespace

void declareOptions(CLI::App& app, Options& options) {
    app.require_subcommand(1);
    app.set_version_flag("--version", "quasilux " QUASILUX_VERSION, "Print the version");

    declareRenderCommand(app, options.render);
    declareViewCommand(app, options.view);
    declareMerge(app, options.merge);
    declareCompare(app, options.compare);
    declarePhotometry(app, options.photometry);
    declareFalseColour(app, options.falseColour);
    declareReport(app, options.report);
    declareDgp(app, options.dgp);
    declareBench(app, options.bench);

    CLI::App& devices = *app.add_subcommand("devices", "List the OpenCL devices");
    devices.add_flag("--json", options.devicesJson, "The list on stdout as a JSON array (default: off, a table)");

    CLI::App& doctor = *app.add_subcommand("doctor", "Say what is wrong with devices and libraries, and what to do");
    doctor.add_flag("--json", options.doctorJson, "What is found on stdout as a JSON array (default: off, lines)");

    CLI::App& manual =
        *app.add_subcommand("manual", "Write man pages and completions of bash, zsh and fish, made of these texts");
    manual.add_option("FOLDER", options.manualFolder, "Where they go, as into /usr/share or ~/.local/share")
        ->required()
        ->type_name("FOLDER");

    CLI::App& info =
        *app.add_subcommand("info", "Print what a scene needs and what is chosen for it, after a trial pass");
    declareSceneFile(info, options.info);
    declareScene(info, options.info, "");
    declareSettings(info, options.info);
    declareDevice(info, options.info);
}

} // namespace quasilux
