// What is said of a render when it is over: its record, and its further layers.
#pragma once

#include "cli/options.h"
#include "output/render_record.h"
#include "render/aovs.h"

#include <optional>
#include <string>
#include <vector>

namespace quasilux {

/// Times of loading and writing are not among it yet.
RenderRecord makeRecord(const Scene& scene, const StopRule& stop, Device& device, const AutoRender& render,
                        bool interrupted);

/// renderAovs() for the image.
std::vector<AovImage> renderLayers(Device& device, const Scene& scene, const AutoRender& render);

/// Illuminance of free ground, lx, where daylight factors are asked for: then the scene's other lights are left out,
/// which is added to `warnings`.
std::optional<double> skyOfDaylightFactor(const RenderOptions& options, Scene& scene,
                                          std::vector<std::string>& warnings);

} // namespace quasilux
