// <phase type="isotropic">: all directions alike.
#include "scene/phases/phase_plugin.h"

namespace quasilux {

void readIsotropic(Properties& /*properties*/, MediumDescription& medium) { medium.phase = PHASE_ISOTROPIC; }

} // namespace quasilux
