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
        return lobe.device.reflectanceTexture != 0 || lobe.device.transmittanceTexture != 0;
    };
    return std::any_of(front.begin(), front.end(), textured) || std::any_of(back.begin(), back.end(), textured);
}

double phongHalfWidth(double exponent) { return std::acos(std::pow(0.5, 1 / (exponent + 1))); }

double ggxHalfWidth(double alpha) { return std::min(2 * std::atan(alpha), halfPi); }

double beckmannHalfWidth(double alpha) { return std::min(2 * std::atan(alpha * std::sqrt(std::log(2.0))), halfPi); }

} // namespace quasilux
