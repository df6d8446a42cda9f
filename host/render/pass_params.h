// Parameters of the kernels of a pass, but for what changes from pass to pass.
#pragma once

#include "pass_types.h"
#include "prepare/device_scene.h"
#include "render/pass_part.h"
#include "render/settings.h"

namespace quasilux {

/// Of density estimates in pass 0, for photons spread evenly over this area. Scene units.
double firstRadiusByArea(double area, const RenderSettings& settings, unsigned photons);

/// The scene as this render needs it.
DeviceScene flattenFor(const Scene& scene, const RenderSettings& settings, const SceneGeometry* known = nullptr);

/// The most segments of a path, as kernels have it: QL_NONE where there is no limit.
unsigned maxDepthOf(const Scene& scene);
shared::PhotonParams photonParams(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings);
/// Of fewer photons, with all flux between them.
shared::PhotonParams withPaths(shared::PhotonParams params, unsigned paths);
/// Sets what the random numbers of photons or camera paths go by.
template <typename Params>
void setNumbers(Params& params, uint64_t seed, unsigned pass = 0, PassPart part = {}) {
    const uint64_t ofPart = part.seedOf(seed);
    params.seedLow = static_cast<unsigned>(ofPart);
    params.seedHigh = static_cast<unsigned>(ofPart >> 32);
    params.pass = pass;
}
shared::CameraParams cameraParams(const DeviceScene& flat, const RenderSettings& settings, unsigned maxDepth);
/// Of a pass, or a part of it; `params` as cameraParams() returns them.
shared::CameraParams ofPass(shared::CameraParams params, unsigned pass, PassPart part);

/// Of the order of what the scene shows: the unit of splats need be no better.
double meanRadiance(const DeviceScene& flat);

} // namespace quasilux
