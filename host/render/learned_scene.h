// What is learned before pass 0, with the kernels of the render's own passes (docs/method/learning.md).
#pragma once

#include "learn/learning.h"
#include "render/geometry_buffers.h"
#include "render/settings.h"

namespace quasilux {

/// Follows importance paths from the camera and rounds of photons from the emitters, as far as they serve the image; `flat` and the tables of `geometry` have
/// what they found. Empty where there is nothing to learn, learns().
LearnedScene learnScene(Device& device, const Program& program, const Scene& scene, const RenderSettings& settings,
                        DeviceScene& flat, GeometryBuffers& geometry);

/// Samples of emitters where a camera path scatters first, one of `cameraPaths` of a pixel in a pass that gather photons of
/// `classes` (bits): several where each must choose one of many, and few paths share the choices out.
unsigned directSamplesOf(const LearnedScene& learned, unsigned classes, unsigned cameraPaths);

} // namespace quasilux
