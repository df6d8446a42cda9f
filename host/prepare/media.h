// Which medium lies where: around shapes, the camera and the emitters.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Indices into Scene::media, MEDIUM_NONE, or (surfaces that bound no medium) MEDIUM_UNCHANGED. Of an emitter, a camera or
/// a grid MEDIUM_BY_PLACE where a border of media may pass through it: each ray finds out for itself.
struct MediumPlacement {
    std::vector<unsigned> interior, exterior; ///< by shape: behind the surface, and on the side of its normal
    std::vector<unsigned> shapeEmitters;      ///< by shape: what its emitter emits into
    std::vector<unsigned> pointEmitters;      ///< by point emitter
    unsigned camera = MEDIUM_NONE;
    std::vector<unsigned> grids; ///< by grid that is measured
};

/// What the scene states holds. Where a shape states only one of interior and exterior, the other one, and likewise
/// what surrounds a camera, a point emitter or an emitting shape that states nothing, is the medium inside of the
/// innermost closed shape that states media and holds the place (nested dielectrics by innermost boundary). It is none
/// inside of a shape that states only its outer medium, as in Mitsuba, and where no shape holds the place. The inside
/// of a closed shape whose normals point inwards is its `exterior`. Shapes that are closed only together hold nothing.
MediumPlacement placeMedia(const Scene& scene);

} // namespace quasilux
