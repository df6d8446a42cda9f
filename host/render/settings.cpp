// Names of the settings, and what a scene file says of them.
#include "render/settings.h"

#include "util/nearest.h"

namespace quasilux {

RenderSettings settingsFromScene(const Scene& scene) {
    const SceneSettings& said = scene.settings;
    RenderSettings settings;
    settings.emission = Emission::guided;
    // A meter is often small: paths from it find what reaches it by quasi-specular lobes, photons hardly ever meet it.
    if (isIrradiance(scene.sensor.meter)) settings.variant = Variant::alternative;
    try {
        if (said.bdd) settings.bdd = *said.bdd;
        if (said.variant) settings.variant = parseVariant(*said.variant);
        if (said.direct) settings.direct = parseDirect(*said.direct);
        if (said.caustics) settings.caustics = parseCaustics(*said.caustics);
        if (said.map) settings.map = parseMapOrder(*said.map);
        if (said.quasiSpecular) settings.quasiSpecular = *said.quasiSpecular;
        if (said.photons) settings.photonsPerPass = *said.photons;
        if (said.cameraPaths) settings.cameraPaths = *said.cameraPaths;
        if (said.seed) settings.seed = *said.seed;
        settings.photometric = said.units == "photometric";
    } catch (const InputError& error) {
        throw InputError({scene.path}, error.what());
    }
    return settings;
}

const char* name(Variant variant) { return variant == Variant::main ? "main" : "alternative"; }

const char* name(DirectLight direct) { return direct == DirectLight::emitters ? "emitters" : "photons"; }

const char* name(CausticLight caustics) { return caustics == CausticLight::photons ? "photons" : "paths"; }

const char* name(MapOrder map) { return map == MapOrder::photons ? "photons" : "camera"; }

const char* name(Emission emission) { return emission == Emission::guided ? "guided" : "plain"; }

const char* name(RadiusChoice radius) { return radius == RadiusChoice::adaptive ? "adaptive" : "fixed"; }

Variant parseVariant(const std::string& text) {
    if (text == "main") return Variant::main;
    if (text == "alternative") return Variant::alternative;
    throw InputError("unknown variant '" + text + "', " + expectedNames(text, {"main", "alternative"}));
}

DirectLight parseDirect(const std::string& text) {
    if (text == "emitters") return DirectLight::emitters;
    if (text == "photons") return DirectLight::photons;
    throw InputError("unknown way to estimate direct light '" + text + "', " +
                     expectedNames(text, {"emitters", "photons"}));
}

CausticLight parseCaustics(const std::string& text) {
    if (text == "photons") return CausticLight::photons;
    if (text == "paths") return CausticLight::paths;
    throw InputError("unknown way to estimate caustic light '" + text + "', " +
                     expectedNames(text, {"photons", "paths"}));
}

MapOrder parseMapOrder(const std::string& text) {
    if (text == "photons") return MapOrder::photons;
    if (text == "camera") return MapOrder::camera;
    throw InputError("unknown map '" + text + "', " + expectedNames(text, {"photons", "camera"}));
}

Emission parseEmission(const std::string& text) {
    if (text == "guided") return Emission::guided;
    if (text == "plain") return Emission::plain;
    throw InputError("unknown emission '" + text + "', " + expectedNames(text, {"guided", "plain"}));
}

RadiusChoice parseRadiusChoice(const std::string& text) {
    if (text == "adaptive") return RadiusChoice::adaptive;
    if (text == "fixed") return RadiusChoice::fixed;
    throw InputError("unknown choice of the radius '" + text + "', " + expectedNames(text, {"adaptive", "fixed"}));
}

} // namespace quasilux
