// <bsdf type="thindielectric">: a pane so thin that light passes without a shift.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readThinDielectric(Properties& properties) {
    DielectricBorder border = readDielectricBorder(properties, LOBE_THINDIELECTRIC, 0);
    border.lobe.device.scattering = SCATTER_SPECULAR;
    BsdfLobes lobes;
    lobes.front.push_back(border.seenFrom(border.outside, border.inside)); // the same pane from either side
    lobes.back.push_back(border.seenFrom(border.outside, border.inside));
    return lobes;
}

} // namespace quasilux
