// What a render will take of memory, before it takes it (docs/method/memory.md).
#pragma once

#include "prepare/device_scene.h"
#include "render/planned_buffer.h"
#include "render/settings.h"

#include <cstdint>
#include <functional>

namespace quasilux {

uint64_t sumOf(const BufferSizes& sizes);

/// Memory that the whole render takes at most, forecast before its first pass.
struct MemoryForecast {
    uint64_t deviceBytes = 0;
    uint64_t hostPeakBytes = 0; ///< of the process; buffers of a CPU device included
};

/// Buffers that depend on the scene and the film alone.
BufferSizes planScene(const DeviceScene& scene, const RenderSettings& settings, const DeviceInfo& device);

/// All buffers of a pass of --map photons, which comes in so many parts, with room for so many `photons` of one of them.
BufferSizes planPass(const DeviceScene& scene, const RenderSettings& settings, uint64_t photons,
                     const DeviceInfo& device, unsigned parts = 1);

/// Photons that so many paths store, at most in all likelihood.
using StoredPhotons = std::function<uint64_t(unsigned paths)>;

inline constexpr unsigned mostParts = 64; ///< of a pass: each traces camera paths anew

/// In how few parts a pass of --map photons has to come to fit into the device's memory, or mostParts.
unsigned partsThatFit(const DeviceScene& scene, const RenderSettings& settings, const StoredPhotons& stored,
                      const DeviceInfo& device);

/// Bytes of the image on the host.
uint64_t imageBytes(const DeviceScene& scene, const RenderSettings& settings);

/// The same while its error is estimated.
uint64_t developBytes(const DeviceScene& scene, const RenderSettings& settings);

/// Throws InputError that says by how much the buffers exceed the device's memory, and what to do; where photons are
/// `stored`, how many to trace, so that they fit.
void checkFits(const BufferSizes& sizes, const DeviceInfo& device, const DeviceScene& scene,
               const RenderSettings& settings, const StoredPhotons& stored = {});

} // namespace quasilux
