// <bsdf type="conductor">: a smooth metal or mirror.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readConductor(Properties& properties) {
    LobeDescription lobe =
        makeLobe(LOBE_CONDUCTOR, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    lobe.device.scattering = SCATTER_SPECULAR;
    readConductorIndex(properties, lobe.device);
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    return lobes;
}

} // namespace quasilux
