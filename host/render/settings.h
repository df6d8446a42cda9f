// What decides the image besides the scene: the method, its numbers, and when to stop.
#pragma once

#include "prepare/features.h"
#include "render/film_layout.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace quasilux {

struct RenderSettings {
    unsigned bdd = 0;                ///< backward diffuse depth: genuine diffuse scatterings of a camera path
    Variant variant = Variant::main; ///< settingsFromScene: alternative
    DirectLight direct = DirectLight::emitters;
    CausticLight caustics = CausticLight::photons;
    MapOrder map = MapOrder::photons;
    Emission emission = Emission::plain;      ///< settingsFromScene: guided
    std::string quasiSpecular = "auto";       ///< auto | none | all | ID,ID,…
    bool quasiSpecularOverridesScene = false; ///< then it overrides what the bsdfs of the scene say
    unsigned photonsPerPass = 0;              ///< emitted; 0 = chosen from the image size
    unsigned cameraPaths = 1;                 ///< of a pixel in each pass; of meters and with the camera map it is 1
    CameraSampling cameraSampling = CameraSampling::even; ///< adaptive: `cameraPaths` are those of the mean pixel
    uint64_t seed = 1;
    RadiusChoice radius = RadiusChoice::adaptive;
    double radiusScale = 1.0;    ///< factor on the initial density radius
    bool photometric = false;    ///< radiance is in cd/m^2, not W sr^-1 m^-2: only what readings in lux and cd/m^2 say
    bool genericKernels = false; ///< compile every feature, used or not (for comparison)
    /// Of photons, as bits of photonClasses(): kernels serve splits and variants that use them, too; not 0 in a search
    unsigned furtherClasses = 0;
    /// Of tests alone: kernels serve scenes with these features, too, so that many scenes share one program
    std::shared_ptr<const Features> furtherFeatures;
    bool estimateBias = true;   ///< beside the image; see estimatesBias() in method.h
    FilmLayout film;            ///< what it is to keep; see filmLayout() in method.h
    bool energyBalance = false; ///< count what becomes of the photons' flux
    bool countGathered = false; ///< after the image: which photons of one more pass camera paths gather
    /// Of tests alone: compiler options that switch on a known mistake (tests/support/wrong_rules.h)
    std::string controlOptions;
};

/// Time of a render that no rule ends.
inline constexpr double defaultSeconds = 30;

/// The first limit reached ends the render; none set = defaultSeconds.
struct StopRule {
    std::optional<double> seconds;
    std::optional<unsigned> passes;      ///< number of the pass that is rendered no more
    unsigned firstPass = 0;              ///< where it begins: of a farm each machine has passes of its own
    std::optional<double> relativeError; ///< ErrorEstimate::sum()
};

/// Whether a pass may have several camera paths for a pixel: meters have a number of paths of their own, and the camera
/// map would store the points of all.
inline bool mayHaveCameraPaths(bool isMeter, const RenderSettings& settings) {
    return !isMeter && settings.map == MapOrder::photons;
}

/// Defaults, then what the scene says. The command line writes over the result.
RenderSettings settingsFromScene(const Scene& scene);

} // namespace quasilux
