// Lobes and their widths.
#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {
constexpr double halfPi = 1.5707963267948966;
}

LobeDescription makeLobe(unsigned type, const std::string& name, const Reflectance& reflectance, double halfWidth) {
    LobeDescription lobe;
    lobe.device.type = type;
    lobe.device.reflectance = reflectance.scale;
    lobe.device.reflectanceTexture = reflectance.texture;
    lobe.name = name;
    lobe.halfWidth = halfWidth;
    return lobe;
}

shared::LobeWeight weightBy(unsigned texture, double offset, double factor) {
    return {texture, WEIGHT_VALUE, WEIGHS_REFLECTED | WEIGHS_TRANSMITTED, static_cast<float>(offset),
            static_cast<float>(factor)};
}

std::vector<unsigned> Bsdf::textures() const {
    std::vector<unsigned> all;
    for (const auto* side : {&front, &back})
        for (const LobeDescription& lobe : *side) {
            for (const unsigned number : {lobe.device.reflectanceTexture, lobe.device.transmittanceTexture,
                                          lobe.device.etaTexture, lobe.device.kTexture})
                if (number > 0) all.push_back(number - 1);
            for (const shared::LobeWeight& weight : lobe.weights) all.push_back(weight.texture);
            for (const LevelTexture& level : lobe.levelTextures) all.push_back(level.texture);
        }
    for (const auto* relief : {&frontRelief, &backRelief})
        if (*relief) all.push_back((*relief)->texture);
    return all;
}

bool Bsdf::letsPass() const {
    const auto passes = [](const LobeDescription& lobe) { return LOBE_PASSES(lobe.device.type); };
    return isNull || std::any_of(front.begin(), front.end(), passes) || std::any_of(back.begin(), back.end(), passes);
}

bool Bsdf::isAnisotropic() const {
    const auto differs = [](const LobeDescription& lobe) {
        return LOBE_HAS_TWO_ALPHAS(lobe.device.type) &&
               (lobe.axesByTexture || lobe.device.alphaU != lobe.device.alphaV);
    };
    return std::any_of(front.begin(), front.end(), differs) || std::any_of(back.begin(), back.end(), differs);
}

bool Bsdf::hasIndexTexture() const {
    const auto varies = [](const LobeDescription& lobe) { return lobe.device.etaTexture + lobe.device.kTexture > 0; };
    return std::any_of(front.begin(), front.end(), varies) || std::any_of(back.begin(), back.end(), varies);
}

LobeDescription passageLobe() {
    LobeDescription lobe = makeLobe(LOBE_PASSAGE, "passage", Rgb{0, 0, 0}, 0);
    lobe.device.scattering = SCATTER_SPECULAR;
    lobe.device.transmittance = {1, 1, 1};
    return lobe;
}

double phongHalfWidth(double exponent) { return std::acos(std::pow(0.5, 1 / (exponent + 1))); }

double ggxHalfWidth(double alpha) { return std::min(2 * std::atan(alpha), halfPi); }

double beckmannHalfWidth(double alpha) { return std::min(2 * std::atan(alpha * std::sqrt(std::log(2.0))), halfPi); }

} // namespace quasilux
