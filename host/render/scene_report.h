// What a scene needs and what was decided for it, in words (SceneReport).
#pragma once

#include "render/memory_plan.h"

#include <optional>

namespace quasilux {

struct LearnedScene;

/// XXH3 by part of a scene.
using SceneChecksums = std::map<std::string, std::string>;

/// What a scene needs and what was chosen for it: `quasilux info` prints it, statistics record it.
struct SceneReport {
    size_t triangles = 0, spheres = 0, patches = 0, borderSegments = 0, instances = 0;
    std::vector<std::string> features; ///< compiled in, such as "lobe phong", "emitter rectangle"
    struct EmitterRow {
        std::string id, type;
        double power = 0;    ///< W, mean of R, G, B
        double radiance = 0; ///< EmitterTables::radiance
    };
    std::vector<EmitterRow> emitters;
    struct LobeRow {
        std::string bsdf, lobe, scattering, why;
    };
    std::vector<LobeRow> lobes;
    struct MediumRow {
        std::string medium, why;
        double level = 0;                              ///< shared::Medium::level
        double kernelRadius = 0, kernelHalfHeight = 0; ///< of the diffuse class in pass 0, scene units; 0 high: a ball
    };
    std::vector<MediumRow> media;
    std::vector<std::string> photonClasses; ///< stored
    std::map<std::string, uint64_t> bufferBytes;
    MemoryForecast forecast;
    unsigned photonsPerPass = 0;
    unsigned photonParts = 1;                    ///< of a pass (pass_part.h)
    std::map<std::string, double> initialRadius; ///< scene units, by photon class
    /// What was learned before pass 0 (docs/method/learning.md).
    struct Learned {
        bool isGuided = false;
        size_t leaves = 0, openings = 0, aims = 0, emittersByPhotons = 0;
        unsigned directSamples = 1;
        bool hasWeightWindows = false;
        double lightOfPhotons = 0; ///< LearnedScene
        /// Effective number of photons of a pass for it: as many equal ones have the same variance; where known.
        std::optional<double> effectivePhotons;
        std::vector<std::pair<double, double>> radiusFactors; ///< at these distances from the eye; empty: 1
        double seconds = 0;
    } learned;
    std::vector<std::string> warnings; ///< DeviceScene::warnings
    /// "geometry", "materials", "camera": of the scene as it is rendered. A file that says the same in another way has
    /// the same.
    SceneChecksums checksums;
};

/// "diffuse", "volume diffuse": a slot of the photon map.
std::string slotName(unsigned slot);

/// All that is known before anything is learned; radii are left out.
SceneReport describeScene(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings);

/// SceneReport::learned; `photons` of a pass.
SceneReport::Learned describeLearned(const LearnedScene& learned, const shared::RadiusField& field, unsigned photons);

/// SceneReport::checksums, of a scene that has just been flattened.
SceneChecksums checksumsOf(const DeviceScene& flat, int maxDepth);
/// Throws InputError that names the parts of the scene that differ.
void requireSame(const SceneChecksums& expected, const SceneChecksums& found);

} // namespace quasilux
