#include "auto/freedom.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

bool statesSplit(const Scene& scene) {
    const auto stated = [](const LobeDescription& lobe) { return lobe.quasiSpecular.stated; };
    const auto ofBsdf = [&](const Bsdf& bsdf) {
        return std::any_of(bsdf.front.begin(), bsdf.front.end(), stated) ||
               std::any_of(bsdf.back.begin(), bsdf.back.end(), stated);
    };
    return scene.settings.quasiSpecular || std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), ofBsdf) ||
           std::any_of(scene.media.begin(), scene.media.end(),
                       [](const MediumDescription& medium) { return medium.quasiSpecular.stated; });
}

} // namespace

Freedom freedomOf(const Scene& scene, AutoMode mode) {
    if (mode == AutoMode::off) return {};
    const SceneSettings& said = scene.settings;
    // Paths by pixel are judged by pilots that have the same number in all.
    if (mode == AutoMode::all) return {true, true, true, true, true, true, true, !said.cameraSampling};
    return {!said.bdd, !statesSplit(scene), !said.variant,  !said.photons,
            true,      !said.cameraPaths,   !said.caustics, !said.cameraPaths && !said.cameraSampling};
}

std::string whyNotSearched(const Scene& scene, const RenderSettings& settings, const StopRule& stop) {
    // Without the bias the widest radius would always seem best.
    if (scene.sensor.meter != MeterKind::none) return "the bias of a meter's readings is not known";
    if (settings.map == MapOrder::camera) return "the bias is not known with --map camera";
    if (!settings.film.bias) return "the bias is not known with --without bias";
    if (stop.passes) return "with --passes the result must not depend on timing";
    return {};
}

std::string text(const Freedom& freedom) {
    std::vector<std::string> names;
    if (freedom.bdd) names.emplace_back("BDD");
    if (freedom.split) names.emplace_back("split");
    if (freedom.variant) names.emplace_back("variant");
    if (freedom.photons) names.emplace_back("photons per pass");
    if (freedom.radius) names.emplace_back("radius");
    if (freedom.cameraPaths) names.emplace_back("camera paths");
    if (freedom.caustics) names.emplace_back("caustics");
    if (freedom.cameraSampling) names.emplace_back("camera sampling");
    return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

} // namespace quasilux
