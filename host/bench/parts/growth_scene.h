// A scene of any number of triangles, to see how costs grow.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// The modified Cornell box (scenes/cornell_phong.xml) with a bumpy sphere of about so many triangles in place of the
/// boxes: smooth, Lambert and a narrow Phong lobe. A square film of `resolution`².
Scene growthScene(unsigned triangles, unsigned resolution);

} // namespace quasilux
