// Layers of integrator 'aov': what the rays of each pixel meet first (kernels/aovs.cl).
#pragma once

#include "device/device.h"
#include "render/settings.h"

namespace quasilux {

struct AovImage {
    std::vector<std::string> channels; ///< names, such as "nn.X"
    std::vector<float> values;         ///< pixel by pixel, one for each channel
};

/// The layers that the scene asks for, alpha where its film wants it ("A"); means over `samples` for each pixel.
std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const RenderSettings& settings, unsigned samples);

} // namespace quasilux
