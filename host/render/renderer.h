// The method, stage by stage: photons, map, camera paths, film. Calls only named stages.
#pragma once

#include "render/energy_balance.h"
#include "render/film_image.h"
#include "render/gathered_photons.h"
#include "render/settings.h"
#include "util/state_archive.h"

#include <atomic>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace quasilux {

struct LearnedScene;
class Film;

/// Memory that the whole render takes at most, forecast before its first pass.
struct MemoryForecast {
    uint64_t deviceBytes = 0;
    uint64_t hostPeakBytes = 0; ///< of the process; buffers of a CPU device included
};

/// XXH3 by part of a scene.
using SceneChecksums = std::map<std::string, std::string>;

/// What a scene needs and what was chosen for it: `quasilux info` prints it, statistics record it.
struct SceneReport {
    size_t triangles = 0, spheres = 0, patches = 0, borderSegments = 0;
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
    /// "geometry", "materials", "camera": of the scene as it is rendered. A file that says the same in another way has the same.
    SceneChecksums checksums;
};

/// Counted over all passes.
struct RenderCounters {
    uint64_t passes = 0;
    uint64_t photonsEmitted = 0;
    std::map<std::string, uint64_t> photonsStored;      ///< by class; in media "volume " and the class
    std::map<std::string, uint64_t> cameraPointsStored; ///< the same for the camera map
    uint64_t storedPoints = 0; ///< photons or camera points in the map of one pass, the most of all passes
    uint64_t storedBytes = 0;  ///< that they take, traced and in the index
    uint64_t cameraPaths = 0;
    uint64_t nonFinite = 0; ///< samples dropped since they were not finite; a right render has none
    uint64_t cutPaths = 0;  ///< paths ended by the hard limit on events
    uint64_t overflows = 0; ///< sums of splats that left their range (camera map); a right render has none
    uint64_t clipped = 0;   ///< photons with more flux than can be stored, which is cut to that
    std::optional<uint64_t>
        meterCaustics;                   ///< photons of caustics that an irradiance meter has met; where it counts any
    double fluxEmitted = 0, fluxCut = 0; ///< W, mean of R, G, B
    std::optional<EnergyBalance> energy; ///< where RenderSettings::energyBalance asks for it
    double throughputCut = 0;            ///< of camera paths, mean of R, G, B; each begins with 1
    double prepareSeconds = 0, compileSeconds = 0, firstPassSeconds = 0, renderSeconds = 0;
    double radiusSeconds = 0; ///< of renderSeconds, for choosing radii by pixel in the first passes, and
    uint64_t radiusPaths = 0; ///< camera paths for it, at the largest radius
};

struct Progress {
    std::string phase; ///< "preparing", "compiling", "rendering", "writing"
    unsigned passes = 0;
    double seconds = 0, secondsLeft = -1; ///< -1 unknown
    double photonsPerSecond = 0, pathsPerSecond = 0;
    double relativeError = -1; ///< -1 unknown yet
};

class Renderer {
public:
    /// Prepares the scene, compiles the kernels it needs and learns where photons serve the image, unless that is `known` from
    /// another renderer of the scene. Throws InputError where `expected` is not empty and not SceneReport::checksums: what is
    /// known is of another scene then.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
             std::shared_ptr<const LearnedScene> known = nullptr, const SceneChecksums& expected = {});
    ~Renderer();

    /// Adds the independent estimate number `pass` (from 0) to the film.
    void renderPass(unsigned pass);
    FilmImage develop() const;
    /// Film::developOver.
    void developOver(FilmImage& image) const;
    /// Has no pass failed halfway? Or else a part of it may be in the film.
    bool isFilmWhole() const;
    const Film& film() const;
    const SceneReport& report() const;
    const RenderCounters& counters() const;
    std::shared_ptr<const LearnedScene> learned() const;

    struct FilmShape {
        unsigned width, height;
        FilmLayout layout;
    };
    FilmShape filmShape() const;
    /// The pass after the last one.
    unsigned nextPass() const;
    /// All that passes have left: film and radii. What was learned is not among it.
    void saveState(StateSink& sink) const;
    /// The same bits in another renderer of the same scene and settings, which knows what this one has learned.
    void restoreState(const StateSource& source, const RenderCounters& counters, unsigned nextPass);
    /// Do radii no longer depend on which passes have been rendered here? Then other renderers of the scene and settings, which know what this
    /// one has learned, may take them up.
    bool radiiAreChosen() const;
    void saveRadii(StateSink& sink) const;
    void restoreRadii(const StateSource& source);
    /// Forgets passes, film and counters, but neither radii nor what was learned.
    void clearPasses();
    /// Traces one pass more, which is no part of the image, to count which photons its camera paths gather; none for meters and
    /// --map camera. Compiles kernels for it.
    std::optional<GatheredCount> countGathered();

private:
    struct Stages;
    std::unique_ptr<Stages> stages_;
};

/// What a render has behind it when renderUntil begins.
struct RenderedBefore {
    double seconds = 0; ///< that the stop rule counts
};

/// Called before the first pass, after each, and once more when the last one is done; `seconds` as the stop rule counts them.
using AfterPass = std::function<void(const Renderer& renderer, double seconds, bool isLast)>;

/// What a render came to.
struct RenderOutcome {
    FilmImage image;
    RenderCounters counters;    ///< of the image's passes
    std::exception_ptr failure; ///< what ended it too early; null: nothing
};

/// Renders passes from StopRule::firstPass on (or from the last one rendered on) until the rule, or `interrupted`, ends it. A pass that fails ends it, too:
/// the image is then of the passes before. Throws only where there are none.
RenderOutcome renderAsFarAsItGoes(Renderer& renderer, const StopRule& stop,
                                  const std::function<void(const Progress&)>& onProgress,
                                  const std::atomic<bool>& interrupted, const RenderedBefore& before = {},
                                  const AfterPass& afterPass = {});

/// The same, but throws where a pass fails.
FilmImage renderUntil(Renderer& renderer, const StopRule& stop, const std::function<void(const Progress&)>& onProgress,
                      const std::atomic<bool>& interrupted, const RenderedBefore& before = {});

} // namespace quasilux
