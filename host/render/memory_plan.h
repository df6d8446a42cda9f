// What a render will take of memory, before it takes it (docs/method/memory.md).
#pragma once

#include "prepare/device_scene.h"
#include "render/planned_buffer.h"
#include "render/settings.h"

#include <cstdint>
#include <optional>

namespace quasilux {

uint64_t sumOf(const BufferSizes& sizes);

/// Memory that the whole render takes at most, forecast before its first pass.
struct MemoryForecast {
    uint64_t deviceBytes = 0;
    uint64_t hostPeakBytes = 0; ///< of the process; buffers of a CPU device included
};

/// Buffers that depend on the scene and the film alone.
BufferSizes planScene(const DeviceScene& scene, const RenderSettings& settings, const DeviceInfo& device);

/// All buffers of a pass of --map photons with room for so many `photons`.
BufferSizes planPass(const DeviceScene& scene, const RenderSettings& settings, uint64_t photons,
                     const DeviceInfo& device);

/// Bytes of the image on the host.
uint64_t imageBytes(const DeviceScene& scene, const RenderSettings& settings);

/// The same while its error is estimated.
uint64_t developBytes(const DeviceScene& scene, const RenderSettings& settings);

/// Throws InputError that says by how much the buffers exceed the device's memory, and what to do. `stored`: photons
/// that a pass stores; how many to trace, so that they fit, is said then.
void checkFits(const BufferSizes& sizes, const DeviceInfo& device, const DeviceScene& scene,
               const RenderSettings& settings, std::optional<uint64_t> stored = {});

} // namespace quasilux
