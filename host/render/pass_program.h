// The kernels of a pass: those that a scene needs, and those that are the same for all scenes.
#pragma once

#include "device/program.h"
#include "prepare/device_scene.h"
#include "render/settings.h"

namespace quasilux {

/// Of a pass of this map, with `further` compiler options; `extra` adds or replaces files (tests). Throws DeviceError
/// where they do not build.
Program passProgram(Device& device, MapOrder map, const DeviceScene& scene, const RenderSettings& settings,
                    const std::string& further = "", const std::map<std::string, std::string>& extra = {});

/// Options of adaptive_radius.cl; `classes`: bits of the photon classes in use.
std::string radiusOptions(unsigned classes);

} // namespace quasilux
