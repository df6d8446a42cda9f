// What a scene file says of the settings.
#include "render/settings.h"

namespace quasilux {

RenderSettings settingsFromScene(const Scene& scene) {
    const SceneSettings& said = scene.settings;
    RenderSettings settings;
    settings.emission = Emission::guided;
    // Quasi-caustic photons are few, and one of them in a narrow lobe is a bright dot that a short trial seldom meets.
    // Camera paths find the same light by samples of emitters along the chain. And what is small, as meters are, photons
    // hardly ever meet.
    settings.variant = Variant::alternative;
    if (said.bdd) settings.bdd = *said.bdd;
    if (said.variant) settings.variant = *said.variant;
    if (said.direct) settings.direct = *said.direct;
    if (said.caustics) settings.caustics = *said.caustics;
    if (said.map) settings.map = *said.map;
    if (said.quasiSpecular) settings.quasiSpecular = *said.quasiSpecular;
    if (said.photons) settings.photonsPerPass = *said.photons;
    if (said.cameraPaths) settings.cameraPaths = *said.cameraPaths;
    if (said.cameraSampling) settings.cameraSampling = *said.cameraSampling;
    if (said.seed) settings.seed = *said.seed;
    settings.photometric = said.units == Units::photometric;
    return settings;
}

} // namespace quasilux
