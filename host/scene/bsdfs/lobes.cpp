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

bool Bsdf::isTextured() const {
    const auto textured = [](const LobeDescription& lobe) {
        return lobe.device.reflectanceTexture != 0 || lobe.device.transmittanceTexture != 0 || !lobe.weights.empty();
    };
    return frontRelief || backRelief || std::any_of(front.begin(), front.end(), textured) ||
           std::any_of(back.begin(), back.end(), textured);
}

bool Bsdf::letsPass() const {
    const auto passes = [](const LobeDescription& lobe) { return LOBE_PASSES(lobe.device.type); };
    return isNull || std::any_of(front.begin(), front.end(), passes) || std::any_of(back.begin(), back.end(), passes);
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
