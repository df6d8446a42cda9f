// Lobes and their widths.
#include "scene/bsdfs/bsdf_plugin.h"

#include <cmath>

namespace quasilux {

namespace {
constexpr double halfPi = 1.5707963267948966;
}

LobeDescription makeLobe(unsigned type, const std::string& name, Rgb reflectance, double halfWidth) {
    LobeDescription lobe;
    lobe.device.type = type;
    lobe.device.reflectance = reflectance;
    lobe.name = name;
    lobe.halfWidth = halfWidth;
    return lobe;
}

double phongHalfWidth(double exponent) { return std::acos(std::pow(0.5, 1 / (exponent + 1))); }

double ggxHalfWidth(double alpha) { return std::min(2 * std::atan(alpha), halfPi); }

double beckmannHalfWidth(double alpha) { return std::min(2 * std::atan(alpha * std::sqrt(std::log(2.0))), halfPi); }

} // namespace quasilux
