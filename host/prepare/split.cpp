// Decides for every lobe between genuine diffuse and quasi-specular.
#include "prepare/split.h"

#include "prepare/split_list.h"
#include "scene/quasi_specular.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double degrees = 57.29577951308232;

bool hasSpecialLobe(const Bsdf& bsdf) {
    const auto special = [](const LobeDescription& lobe) {
        return !LOBE_IS_BROAD(lobe.device.type) && !LOBE_PASSES(lobe.device.type);
    };
    return std::any_of(bsdf.front.begin(), bsdf.front.end(), special) ||
           std::any_of(bsdf.back.begin(), bsdf.back.end(), special);
}

bool isListed(const std::vector<std::string>& list, const Bsdf& bsdf, const LobeDescription& lobe) {
    const bool wholeBsdf = std::find(list.begin(), list.end(), bsdf.id) != list.end();
    const bool thisLobe = std::find(list.begin(), list.end(), bsdf.id + '.' + lobe.name) != list.end();
    return thisLobe || (wholeBsdf && (!LOBE_IS_BROAD(lobe.device.type) || !hasSpecialLobe(bsdf)));
}

LobeDecision byWidth(const LobeDescription& lobe) {
    const bool narrow = lobe.halfWidth < quasiSpecularHalfWidth;
    return {narrow ? SCATTER_QUASI_SPECULAR : SCATTER_GENUINE_DIFFUSE,
            fmt::format("auto: half width {:.1f} deg {} {:.0f} deg", lobe.halfWidth * degrees,
                        narrow ? "<" : ">=", quasiSpecularHalfWidth * degrees)};
}

LobeDecision byScene(const LobeDescription& lobe) {
    const auto& choice = lobe.quasiSpecular;
    switch (choice.kind) {
    case QuasiSpecularChoice::Kind::yes:
        return {SCATTER_QUASI_SPECULAR, "the scene: yes"};
    case QuasiSpecularChoice::Kind::no:
        return {SCATTER_GENUINE_DIFFUSE, "the scene: no"};
    case QuasiSpecularChoice::Kind::automatic:
        return byWidth(lobe);
    case QuasiSpecularChoice::Kind::lobes:
    case QuasiSpecularChoice::Kind::level: // the loader gives it to media only
        break;
    }
    const bool named = std::find(choice.lobes.begin(), choice.lobes.end(), lobe.name) != choice.lobes.end();
    return {named ? SCATTER_QUASI_SPECULAR : SCATTER_GENUINE_DIFFUSE,
            named ? "the bsdf names this lobe" : "the bsdf does not name this lobe"};
}

LobeDecision decide(const Bsdf& bsdf, const LobeDescription& lobe, const std::string& setting,
                    const std::vector<std::string>& list, bool overridesScene) {
    if (lobe.device.scattering == SCATTER_SPECULAR) return {SCATTER_SPECULAR, "delta"};
    if (lobe.quasiSpecular.stated && (!overridesScene || setting == "auto")) return byScene(lobe);
    if (setting == "auto") return byWidth(lobe);
    if (setting == "none") return {SCATTER_GENUINE_DIFFUSE, "setting: none"};
    if (setting == "all") return {SCATTER_QUASI_SPECULAR, "setting: all"};
    const bool listed = isListed(list, bsdf, lobe);
    return {listed ? SCATTER_QUASI_SPECULAR : SCATTER_GENUINE_DIFFUSE,
            listed ? "setting: listed" : "setting: not listed"};
}

} // namespace

std::vector<BsdfDecision> decideSplit(const Scene& scene, const std::string& asked, bool overridesScene) {
    const std::string setting = isPhaseLevel(asked) ? "auto" : asked; // a level says nothing of lobes
    const std::vector<std::string> list = listedIds(scene, setting);
    std::vector<BsdfDecision> decisions;
    for (const auto& bsdf : scene.bsdfs) {
        BsdfDecision decision;
        for (const auto& lobe : bsdf.front) decision.front.push_back(decide(bsdf, lobe, setting, list, overridesScene));
        for (const auto& lobe : bsdf.back) decision.back.push_back(decide(bsdf, lobe, setting, list, overridesScene));
        decisions.push_back(std::move(decision));
    }
    return decisions;
}

} // namespace quasilux
