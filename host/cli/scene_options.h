// Options that all commands with a scene share.
#pragma once

#include "auto/freedom.h"
#include "render/settings.h"

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
    bool untrusted = false, allowOutside = false;
    std::vector<std::string> limits; ///< "name=number", of scenes that are not trusted
    std::optional<unsigned> bdd, photons, cameraPaths;
    std::optional<uint64_t> seed;
    std::optional<std::string> variant, direct, caustics, map, emission, quasiSpecular, radius, cameraSampling;
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
    std::optional<LoadLimits> loadLimits() const;
    LoadChoice choice() const { return {sensor, unknown(), loadLimits()}; }
    /// The scene's settings, overridden by what was given here. Throws InputError.
    RenderSettings settings(const Scene& loaded) const;
    /// What is left to a search.
    Freedom freedom(const Scene& loaded) const;
};

void declareSceneFile(CLI::App& command, SceneOptions& options);
/// `moreSensors` is said of --sensor.
void declareScene(CLI::App& command, SceneOptions& options, const std::string& moreSensors);
void declareSettings(CLI::App& command, SceneOptions& options);
void declareDevice(CLI::App& command, SceneOptions& options);

} // namespace quasilux
