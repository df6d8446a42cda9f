// <phase type="rayleigh">: particles much smaller than the wavelength, light unpolarised.
#include "scene/phases/phase_plugin.h"

namespace quasilux {

void readRayleigh(Properties& /*properties*/, MediumDescription& medium) { medium.phase = PHASE_RAYLEIGH; }

} // namespace quasilux
