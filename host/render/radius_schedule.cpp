#include "render/radius_schedule.h"

#include "render/method.h"
#include "render/pass_params.h"
#include "render/radius.h"

namespace quasilux {

namespace {

// Photons of a class that is rare are gathered from so many times as far as all together would be: where such light is
// weak, a wider disc costs more than its noise.
constexpr double rareClassRadius = 2;

} // namespace

RadiusSchedule::RadiusSchedule(const DeviceScene& flat, const RenderSettings& settings, const LearnedScene& learned)
    : scale_(settings.radiusScale),
      firstByArea_(firstRadiusByArea(flat.surfaceArea, settings, photonsPerPass(settings, flat.camera))) {
    const unsigned photons = photonsPerPass(settings, flat.camera);
    double all = 0;
    for (const double ofClass : learned.density) all += ofClass;
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
        const double byArea = firstByArea_ * classRadiusFactor(c);
        first_[c] = byArea;
        if (!(all > 0)) continue;
        const auto radiusOf = [&](double perPhoton) {
            return perPhoton > 0 ? radiusOfPhotons(perPhoton * photons) : byArea;
        };
        const double byDensity = std::min(radiusOf(learned.density[c]), rareClassRadius * radiusOf(all));
        first_[c] = std::min(byArea, scale_ * byDensity);
    }
}

std::array<float, LIGHT_CLASSES> RadiusSchedule::radii(unsigned pass) const {
    std::array<float, LIGHT_CLASSES> radius{};
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) radius[c] = static_cast<float>(first_[c] * radiusShrink(pass));
    return radius;
}

float RadiusSchedule::volumeScale(unsigned pass) const { return static_cast<float>(scale_ * volumeShrink(pass)); }

} // namespace quasilux
