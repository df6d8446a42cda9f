// What a scene needs and what was decided for it, in words (SceneReport).
#pragma once

#include "prepare/device_scene.h"
#include "render/renderer.h"

namespace quasilux {

/// "diffuse", "volume diffuse": a slot of the photon map.
std::string slotName(unsigned slot);

/// All that is known before anything is learned; radii are left out.
SceneReport describeScene(const Scene& scene, const DeviceScene& flat, const RenderSettings& settings);

/// SceneReport::checksums, of a scene that has just been flattened.
SceneChecksums checksumsOf(const DeviceScene& flat, int maxDepth);
/// Throws InputError that names the parts of the scene that differ.
void requireSame(const SceneChecksums& expected, const SceneChecksums& found);

} // namespace quasilux
