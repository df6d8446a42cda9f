// The method, stage by stage: photons, map, camera paths, film. Calls only named stages.
#pragma once

#include "render/aovs.h"
#include "render/film_image.h"
#include "render/gathered_photons.h"
#include "render/render_counters.h"
#include "render/sampling_gain.h"
#include "render/scene_report.h"
#include "render/settings.h"
#include "util/state_archive.h"

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

namespace quasilux {

struct LearnedScene;
struct SceneGeometry;
class Film;

/// What another renderer of the scene, or of one that differs in camera and emitters alone, has found out already;
/// null: it is found out here.
struct KnownScene {
    KnownScene(std::shared_ptr<const LearnedScene> learned_ = nullptr,
               std::shared_ptr<const SceneGeometry> geometry_ = nullptr)
        : learned(std::move(learned_)), geometry(std::move(geometry_)) {}
    std::shared_ptr<const LearnedScene> learned;   ///< where photons serve the image
    std::shared_ptr<const SceneGeometry> geometry; ///< prepareGeometry()
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
    /// Prepares the scene, compiles the kernels it needs and learns where photons serve the image, unless that is
    /// `known`. Throws InputError where `expected` is not empty and not SceneReport::checksums: what is known is of
    /// another scene then.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings, const KnownScene& known = {},
             const SceneChecksums& expected = {});
    ~Renderer();

    /// Adds the independent estimate number `pass` (from 0) to the film.
    void renderPass(unsigned pass);
    FilmImage develop() const;
    /// renderAovs() of the scene that this renderer was made for, for the passes that it has; they are no part of the
    /// passes' timings.
    std::vector<AovImage> layers(const Scene& scene) const;
    /// Film::developOver.
    void developOver(FilmImage& image) const;
    /// Has no pass failed halfway? Or else a part of it may be in the film.
    bool isFilmWhole() const;
    const Film& film() const;
    const SceneReport& report() const;
    const RenderCounters& counters() const;
    std::shared_ptr<const LearnedScene> learned() const;
    /// What was learned, and the geometry that it was made with, if that was known.
    KnownScene known() const;

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
    /// Do radii no longer depend on which passes have been rendered here? Then other renderers of the scene and
    /// settings, which know what this one has learned, may take them up.
    bool radiiAreChosen() const;
    void saveRadii(StateSink& sink) const;
    void restoreRadii(const StateSource& source);
    /// Forgets passes, film and counters, but neither radii nor what was learned.
    void clearPasses();
    /// Seconds that one camera path of each pixel takes where it gathers no photons; 0 where it gathers none anyway, or
    /// a pass has no more than one. Before the first pass.
    double secondsWithoutGathering();
    /// Pass::samplingGain.
    SamplingGain samplingGain(unsigned paths);
    /// Camera paths that samplingGain() traces, as a multiple of the image's pixels.
    double pathsOfSamplingGain(unsigned paths) const;
    /// Traces one pass more, which is no part of the image, to count which photons its camera paths gather; none for
    /// meters and
    /// --map camera. Compiles kernels for it.
    std::optional<GatheredCount> countGathered();

private:
    struct Stages;
    std::unique_ptr<Stages> stages_;
};

/// Thrown by who looks on, in the middle of a pass or between two: nobody wants the image any more. It comes out of
/// renderAsFarAsItGoes at once.
struct RenderAbandoned : std::exception {
    const char* what() const noexcept override { return "something else is to be rendered"; }
};

/// What a render has behind it when renderAsFarAsItGoes begins.
struct RenderedBefore {
    double seconds = 0; ///< that the stop rule counts
};

/// Called before the first pass, after each, and once more when the last one is done; `seconds` as the stop rule counts
/// them.
using AfterPass = std::function<void(const Renderer& renderer, double seconds, bool isLast)>;

/// What a render came to.
struct RenderOutcome {
    FilmImage image;
    RenderCounters counters;    ///< of the image's passes
    std::exception_ptr failure; ///< what ended it too early; null: nothing
};

/// Renders passes from StopRule::firstPass on (or from the last one rendered on) until the rule, or `interrupted`, ends
/// it. A pass that fails ends it, too: the image is then of the passes before. Throws only where there are none.
RenderOutcome renderAsFarAsItGoes(Renderer& renderer, const StopRule& stop,
                                  const std::function<void(const Progress&)>& onProgress,
                                  const std::atomic<bool>& interrupted, const RenderedBefore& before = {},
                                  const AfterPass& afterPass = {});

} // namespace quasilux
