// Declares the options that all commands with a scene share.
#include "cli/scene_options.h"

#include "cli/option_checks.h"

namespace quasilux {

std::optional<LoadLimits> SceneOptions::loadLimits() const {
    if (!untrusted) return std::nullopt;
    LoadLimits chosen;
    chosen.staysInside = !allowOutside;
    for (const auto& [name, value] : parseDefinitions(limits))
        for (const NamedLimit& limit : namedLimits)
            if (limit.name == name) chosen.*limit.value = std::stoull(value);
    return chosen;
}

namespace {

/// Options of the method, one call each: the kinds of values that several have.
struct MethodOptions {
    CLI::App& command;
    static constexpr const char* group = "Method (overrides the scene's settings)";

    template <NamedChoice Choice>
    void choice(const char* flag, std::optional<std::string>& value, const char* help) {
        command.add_option(flag, value, help)->type_name("NAME")->check(oneOf(choiceNames<Choice>()))->group(group);
    }
    template <typename Number>
    void count(const char* flag, std::optional<Number>& value, uint64_t least, uint64_t most, const char* help) {
        command.add_option(flag, value, help)->type_name("N")->transform(wholeNumber(least, most))->group(group);
    }
};

void declareLight(MethodOptions method, SceneOptions& options) {
    method.count("--bdd", options.bdd, 0, bddLimit,
                 "Backward diffuse depth: genuine diffuse scatterings that a camera path follows before it takes "
                 "its light from the photon map, a count (default: the scene's, else 0)");
    method.choice<Variant>("--variant", options.variant,
                           "Variant of the method: main or alternative (default: the scene's, else searched, else "
                           "alternative)");
    method.command
        .add_option("--quasi-specular", options.quasiSpecular,
                    "Scattering followed like mirrors: auto, none, all, ids of bsdfs (or ID.LOBE) and media with "
                    "commas between, or level:X, the phase functions of media above X per sr (default: the scene's, "
                    "else auto)")
        ->type_name("LIST")
        ->check(quasiSpecularList())
        ->group(MethodOptions::group);
    method.choice<DirectLight>("--direct", options.direct,
                               "Direct light from samples of the emitters or from the photon map: emitters or photons "
                               "(default: the scene's, else emitters)");
    method.choice<CausticLight>("--caustics", options.caustics,
                                "Caustic light, which came by mirrors and clear glass alone, from photons, or found "
                                "by camera paths (with everything quasi-specular and the alternative variant; no "
                                "photons are traced then): photons or paths (default: the scene's, else searched, "
                                "else photons)");
    method.choice<MapOrder>("--map", options.map,
                            "What is stored and indexed in each pass: photons, found by camera paths, or camera "
                            "(points of camera paths, found by photons) (default: the scene's, else photons)");
}

void declareSampling(MethodOptions method, SceneOptions& options) {
    method.choice<Emission>("--emission", options.emission,
                            "Where photons begin: guided (where importance paths found that they serve the image) or "
                            "plain (in proportion to the emitters' power) (default: guided)");
    method.count("--photons", options.photons, 1, photonsLimit,
                 "Photons emitted in each pass, a count (default: the scene's, else chosen from the image size)");
    method.count("--camera-paths", options.cameraPaths, 1, cameraPathsLimit,
                 "Camera paths of a pixel in each pass, which share its photons, a count (default: the scene's, else "
                 "searched, else 1)");
    method.choice<CameraSampling>("--camera-sampling", options.cameraSampling,
                                  "Camera paths by pixel: even (all have the same number) or adaptive (more where "
                                  "they have more noise, found by a noise probe, where there are several) (default: "
                                  "the scene's, else searched unless --camera-paths is given, else even)");
    method.count("--seed", options.seed, 0, UINT64_MAX,
                 "Seed of the random numbers, a whole number below 2^64 (default: the scene's, else 1)");
    method.choice<RadiusChoice>("--radius", options.radius,
                                "Radius of the density estimate: adaptive, chosen for each pixel from its noise and "
                                "bias, or fixed, the same for all (default: adaptive)");
    method.command
        .add_option("--radius-scale", options.radiusScale,
                    "Factor on the initial radius of the density estimate, a ratio (default: 1)")
        ->type_name("X")
        ->check(numberAbove(0, 1000))
        ->group(MethodOptions::group);
    method.command
        .add_flag("--energy-balance", options.energyBalance,
                  "Count what becomes of the photons' flux, for the statistics (default: off)")
        ->group(MethodOptions::group);
}

void declareSearch(MethodOptions method, SceneOptions& options) {
    auto* all =
        method.command
            .add_flag("--auto", options.autoAll,
                      "Search BDD, variant, split, caustics, photons, camera paths and radius by pilot passes, "
                      "but for those given here; the search starts at the scene's settings (default: search what "
                      "neither these options nor the scene fix)")
            ->group(MethodOptions::group);
    method.command
        .add_flag("--fixed", options.fixed, "Search nothing: what is given, else the defaults (default: off)")
        ->group(MethodOptions::group)
        ->excludes(all);
}

} // namespace

void declareSettings(CLI::App& command, SceneOptions& options) {
    const MethodOptions method{command};
    declareLight(method, options);
    declareSampling(method, options);
    declareSearch(method, options);
}

void declareDevice(CLI::App& command, SceneOptions& options) {
    const char* group = "Device";
    command
        .add_option("--device", options.device,
                    "Device number, as `quasilux devices` lists them (default: the first GPU, else the first device)")
        ->type_name("N")
        ->transform(wholeNumber(0, 1000))
        ->group(group);
    command
        .add_option("--work-group-size", options.workGroupSize, "Work-items in each work-group, a count (default: 64)")
        ->type_name("N")
        ->transform(wholeNumber(1, 4096))
        ->group(group);
    command
        .add_option("--device-memory", options.deviceMemory,
                    "Bytes of device memory that the render may take: photons come in parts that fit; what does not "
                    "fit even so ends before it starts (default: what the device has)")
        ->type_name("BYTES")
        ->transform(wholeNumber(1, UINT64_MAX))
        ->group(group);
    command
        .add_option("--without", options.without,
                    "What the film does not keep, to save memory: components (layers of the image by class of light), "
                    "bias (its estimate), or both; the image is the same (default: keeps all)")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(oneOf({"components", "bias"}))
        ->group(group);
    command
        .add_option("--kernels", options.kernels,
                    "Features compiled: scene (those that the scene needs) or generic (all) (default: scene)")
        ->type_name("NAME")
        ->check(oneOf({"scene", "generic"}))
        ->group(group);
}

void declareSceneFile(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, "Scene file, Mitsuba 3 XML or glTF 2.0")->required()->type_name("FILE");
}

void declareScene(CLI::App& command, SceneOptions& options, const std::string& moreSensors) {
    command
        .add_option("--sensor", options.sensor,
                    "Sensor of the scene, by its number in the order of the file, from 0, or by its id" + moreSensors +
                        " (default: 0)")
        ->type_name("N");
    command
        .add_option(
            "-D", options.definitions,
            "Replaces the value of the scene's <default name=\"...\"/>; may be given several times (default: none)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false)
        ->check(definition());
    command.add_flag(
        "--lenient", options.lenient,
        "What the scene says and is not known is left out, or something plain stands in for it, and values "
        "out of range become the nearest within, with a warning at each (default: off, an error)");
    auto* untrusted = command.add_flag(
        "--untrusted", options.untrusted,
        "The scene is not trusted: it may read no files outside of its folder, and has limits (default: off)");
    command
        .add_flag("--allow-outside", options.allowOutside,
                  "Files of a scene that is not trusted may lie outside of its folder (default: off)")
        ->needs(untrusted);
    command
        .add_option(
            "--limit", options.limits,
            "Limit on a scene that is not trusted: memory (MiB), files, mebibytes (in files), pixels, elements, "
            "nesting (of includes) or seconds; may be given several times (default: 4096, 1000, 1024, 67108864, "
            "1000000, 8, 60)")
        ->type_name("NAME=N")
        ->allow_extra_args(false)
        ->check(loadLimit())
        ->needs(untrusted);
    command.add_flag("--json", options.json, "The result on stdout as one JSON object (default: off, text)");
    command.add_flag("--quiet", options.quiet,
                     "No progress, no warnings and no summary; errors and --json are still printed (default: off)");
}

} // namespace quasilux
