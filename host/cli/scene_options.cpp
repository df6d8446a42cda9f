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

void declareSettings(CLI::App& command, SceneOptions& options) {
    const char* group = "Method (overrides the scene's settings)";
    command
        .add_option("--bdd", options.bdd,
                    "Backward diffuse depth: genuine diffuse scatterings that a camera path follows before it takes "
                    "its light from the photon map, a count (default: the scene's, else 0)")
        ->type_name("N")
        ->transform(wholeNumber(0, bddLimit))
        ->group(group);
    command
        .add_option("--variant", options.variant,
                    "Variant of the method: main or alternative (default: the scene's, else main; of irradiance meters "
                    "alternative)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<Variant>()))
        ->group(group);
    command
        .add_option(
            "--quasi-specular", options.quasiSpecular,
            "Scattering followed like mirrors: auto, none, all, ids of bsdfs (or ID.LOBE) and media with commas "
            "between, or level:X, the phase functions of media above X per sr (default: the scene's, else "
            "auto)")
        ->type_name("LIST")
        ->check(quasiSpecularList())
        ->group(group);
    command
        .add_option("--direct", options.direct,
                    "Direct light from samples of the emitters or from the photon map: emitters or photons (default: "
                    "the scene's, else emitters)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<DirectLight>()))
        ->group(group);
    command
        .add_option("--caustics", options.caustics,
                    "Caustic light, which came by mirrors and clear glass alone, from photons, or found by camera "
                    "paths (with everything "
                    "quasi-specular and the alternative variant; no photons are traced then): photons or paths "
                    "(default: the scene's, "
                    "else searched, else photons)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<CausticLight>()))
        ->group(group);
    command
        .add_option("--map", options.map,
                    "What is stored and indexed in each pass: photons, found by camera paths, or camera (points of "
                    "camera paths, found by photons) (default: the scene's, else photons)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<MapOrder>()))
        ->group(group);
    command
        .add_option("--emission", options.emission,
                    "Where photons begin: guided (where pilots found that they serve the image) or plain (in "
                    "proportion to the emitters' power) (default: guided)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<Emission>()))
        ->group(group);
    command
        .add_option("--photons", options.photons,
                    "Photons emitted in each pass, a count (default: the scene's, else chosen from the image size)")
        ->type_name("N")
        ->transform(wholeNumber(1, photonsLimit))
        ->group(group);
    command
        .add_option(
            "--camera-paths", options.cameraPaths,
            "Camera paths of a pixel in each pass, which share its photons, a count (default: the scene's, else "
            "searched, else 1)")
        ->type_name("N")
        ->transform(wholeNumber(1, cameraPathsLimit))
        ->group(group);
    command
        .add_option(
            "--camera-sampling", options.cameraSampling,
            "Camera paths by pixel: even (all have the same number) or adaptive (more where they have more noise, "
            "found by a pilot, where there are several) (default: the scene's, else searched unless --camera-paths is "
            "given, else even)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<CameraSampling>()))
        ->group(group);
    command
        .add_option("--seed", options.seed,
                    "Seed of the random numbers, a whole number below 2^64 (default: the scene's, else 1)")
        ->type_name("N")
        ->transform(wholeNumber(0, UINT64_MAX))
        ->group(group);
    command
        .add_option(
            "--radius", options.radius,
            "Radius of the density estimate: adaptive, chosen for each pixel from its noise and bias, or fixed, "
            "the same for all (default: adaptive)")
        ->type_name("NAME")
        ->check(oneOf(choiceNames<RadiusChoice>()))
        ->group(group);
    command
        .add_option("--radius-scale", options.radiusScale,
                    "Factor on the initial radius of the density estimate, a ratio (default: 1)")
        ->type_name("X")
        ->check(numberAbove(0, 1000))
        ->group(group);
    command
        .add_flag("--energy-balance", options.energyBalance,
                  "Count what becomes of the photons' flux, for the statistics (default: off)")
        ->group(group);
    auto* all = command
                    .add_flag("--auto", options.autoAll,
                              "Search BDD, variant, split, photons per pass and radius by pilot passes, but for those "
                              "given here; the search starts at the scene's settings (default: search what "
                              "neither these options nor the scene fix)")
                    ->group(group);
    command.add_flag("--fixed", options.fixed, "Search nothing: what is given, else the defaults (default: off)")
        ->group(group)
        ->excludes(all);
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
                    "Bytes of device memory that the render may take; one that needs more ends before it starts "
                    "(default: what the device has)")
        ->type_name("BYTES")
        ->transform(wholeNumber(1, UINT64_MAX))
        ->group(group);
    command
        .add_option("--without", options.without,
                    "What the film does not keep, to save memory: components (layers of the image by class of light), "
                    "bias (its estimate), or both; the image is the same (default: keeps all)")
        ->type_name("LIST")
        ->delimiter(',')
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
