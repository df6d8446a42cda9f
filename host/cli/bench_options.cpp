// Declares the options of `quasilux bench`.
#include "cli/bench_options.h"

#include "cli/option_checks.h"

namespace quasilux {

namespace {

void declareReferences(CLI::App& command, BenchOptions& options) {
    command
        .add_option("--reference", options.references,
                    "Image that counts as right, one for each scene in their order, - for none (default: none; errors "
                    "are those "
                    "that renders estimate)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        .add_option(
            "--reference-noise", options.referenceNoise,
            "relMSE of a right image against the reference, its own noise mostly; one for each --reference in their "
            "order (default: 0)")
        ->type_name("X")
        ->allow_extra_args(false)
        ->check(numberBetween(0, 1e30));
}

/// Where one of these is given, error over time is measured only if --method is given too.
void declareParts(CLI::App& command, BenchOptions& options) {
    const char* group = "Parts (besides error over time, which needs --method then)";
    command
        .add_option("--growth", options.growth,
                    "How the cost of a pass grows: triangles, photons, pixels, bdd, of a scene made in code, and "
                    "threads, of each SCENE; several with commas between")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(oneOf({"triangles", "photons", "pixels", "bdd", "threads"}))
        ->group(group);
    command
        .add_option("--growth-steps", options.growthSteps,
                    "Sizes measured of each, from the least one on, a count (default: all)")
        ->type_name("N")
        ->transform(wholeNumber(1, 100))
        ->group(group);
    command
        .add_flag("--compare-devices", options.compareDevices,
                  "The same work on each --device: rates, compile times cold and warm, energy, difference of images")
        ->group(group);
    command
        .add_flag("--compare-kernels", options.compareKernels,
                  "Kernels compiled for each SCENE against generic ones, pass by pass in turns")
        ->group(group);
    command
        .add_flag("--pass-times", options.passTimes,
                  "One pass of each SCENE again and again: the least time, by kernel")
        ->group(group);
}

void declareResults(CLI::App& command, BenchOptions& options) {
    command.add_option("-o,--output", options.output, "All figures, .json (default: none)")->type_name("FILE");
    command.add_option("--html", options.html, "Page with plots, pictures and tables, .html (default: none)")
        ->type_name("FILE");
    command.add_flag("--json", options.json, "The figures on stdout as one JSON object (default: off, tables)");
    command.add_flag("--quiet", options.quiet,
                     "No progress, no warnings and no tables; errors and --json are still printed (default: off)");
}

} // namespace

void declareBench(CLI::App& app, BenchOptions& options) {
    CLI::App& command = *app.add_subcommand("bench", "Measure speed against error, of scenes, methods and devices");
    command
        .add_option(
            "SCENE", options.scenes,
            "Scene files, Mitsuba 3 XML or glTF 2.0; none is needed for --micro, and for --growth but of threads")
        ->type_name("FILE");
    command
        .add_option("--method", options.methods,
                    "Way to render: scene, standard, main or alternative, then, each after a colon, a BDD, photons, "
                    "camera, generic or level=X; may be given several times (default: scene, standard:0, standard:1, "
                    "main:0, main:1, alternative:0)")
        ->type_name("NAME")
        ->allow_extra_args(false);
    command
        .add_option("--device", options.devices,
                    "Device number, as `quasilux devices` lists them; may be given several times (default: the first "
                    "GPU, else the first device)")
        ->type_name("N")
        ->allow_extra_args(false)
        ->transform(wholeNumber(0, 1000));
    command.add_option("--time", options.seconds, "Time of each render, in seconds (default: 10)")
        ->type_name("SECONDS")
        ->check(numberAbove(0, 1e9));
    command
        .add_option_function<std::string>(
            "--micro", [&options](const std::string& parts) { options.micro = parts; },
            "Times single stages against native code, of these parts between commas: traversal, map, gather, samplers, "
            "tree (default: off; without PARTS all of them). Needs no scene; scenes go before it")
        ->type_name("PARTS")
        ->expected(0, 1)
        ->default_str("all");
    declareReferences(command, options);
    declareParts(command, options);
    command
        .add_option("-D", options.definitions,
                    "Replaces the value of the scenes' <default name=\"...\"/>; may be given several times (default: "
                    "none)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false)
        ->check(definition());
    command.add_flag("--lenient", options.lenient,
                     "What the scenes say and is not known is left out, or something plain stands in for it, and "
                     "values out of range become the nearest within, with a warning at each (default: off, an error)");
    declareResults(command, options);
}

} // namespace quasilux
