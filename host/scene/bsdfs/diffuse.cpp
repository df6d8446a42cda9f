// <bsdf type="diffuse">: Lambert reflection on the side of the normal, black from behind.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readDiffuse(Properties& properties) {
    BsdfLobes lobes;
    lobes.front.push_back(
        makeLobe(LOBE_LAMBERT, "diffuse", readReflectance(properties, "reflectance", 0.5f), lambertHalfWidth));
    return lobes;
}

} // namespace quasilux
