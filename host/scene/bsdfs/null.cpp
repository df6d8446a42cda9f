// <bsdf type="null">: a surface that light passes through as if it were not there.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readNull(Properties&) {
    BsdfLobes lobes;
    lobes.isNull = true;
    return lobes;
}

} // namespace quasilux
