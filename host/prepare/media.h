// Which medium lies where: around shapes, the camera and the emitters.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Indices into Scene::media, MEDIUM_NONE, or (surfaces that bound no medium) MEDIUM_UNCHANGED.
struct MediumPlacement {
    std::vector<unsigned> interior, exterior; ///< by shape: behind the surface, and on the side of its normal
    std::vector<unsigned> shapeEmitters;      ///< by shape: what its emitter emits into
    std::vector<unsigned> pointEmitters;      ///< by point emitter
    unsigned camera = MEDIUM_NONE;
};

/// What the scene states holds. Where a shape states only one of interior and exterior, the other one, and likewise what
/// surrounds a camera, a point emitter or an emitting shape that states nothing, is the medium of the innermost closed
/// shape with an interior medium that holds the place (nested dielectrics by innermost boundary), or none.
MediumPlacement placeMedia(const Scene& scene);

} // namespace quasilux
