// Layers of integrator 'aov': what the rays of each pixel meet first (kernels/aovs.cl).
#pragma once

#include "device/device.h"
#include "render/geometry_buffers.h"
#include "render/memory_plan.h"
#include "render/settings.h"

namespace quasilux {

struct AovImage {
    std::vector<std::string> channels; ///< names, such as "nn.X"
    std::vector<float> values;         ///< pixel by pixel, one for each channel
};

/// Buffers while layers are made, which is after those of passes are gone; none where the scene asks for no layers.
BufferSizes planAovs(const Scene& scene, const DeviceScene& flat, const DeviceInfo& device);
/// `forecast` of a render's passes, which have their buffers now; with them, and colours in other terms (PixelFormat).
MemoryForecast withLayers(MemoryForecast forecast, const Scene& scene, const DeviceScene& flat,
                          const RenderSettings& settings, const DeviceInfo& device);

/// The layers that the scene asks for, alpha where its film wants it ("A"); means over `samples` for each pixel.
std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const RenderSettings& settings, unsigned samples);
/// The same of a scene that is flattened and on the device already.
std::vector<AovImage> renderAovs(Device& device, const Scene& scene, const DeviceScene& flat,
                                 const GeometryBuffers& geometry, const RenderSettings& settings, unsigned samples);
/// For an image of so many passes: places in the pixel of as many camera paths; more than some hundreds would hardly
/// change the layers.
unsigned aovSamples(unsigned passes);

} // namespace quasilux
