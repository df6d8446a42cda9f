// Phase functions that are formulas.
#include "scene/phases/phase_plugin.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

/// <phase type="isotropic">: all directions alike.
void readIsotropic(Properties& /*properties*/, MediumDescription& medium) { medium.phase = PHASE_ISOTROPIC; }

/// <phase type="hg">: Henyey and Greenstein 1941, one mean cosine g.
void readHenyeyGreenstein(Properties& properties, MediumDescription& medium) {
    medium.phase = PHASE_HG;
    medium.g = properties.number("g", 0.8);
    if (!(std::abs(static_cast<float>(medium.g)) < 1))
        throw InputError(properties.where("g"),
                         fmt::format("parameter 'g' of {} is {}; it must lie between -1 and 1, both excluded (at ±1 "
                                     "light would go on unscattered, or turn back).",
                                     properties.describe(), medium.g));
}

/// <phase type="rayleigh">: particles much smaller than the wavelength, light unpolarised.
void readRayleigh(Properties& /*properties*/, MediumDescription& medium) { medium.phase = PHASE_RAYLEIGH; }

} // namespace quasilux
