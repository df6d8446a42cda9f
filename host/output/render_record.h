// What is known of a finished render: the headers of the images and the statistics file are made from it.
#pragma once

#include "device/device.h"
#include "render/error_estimate.h"
#include "render/renderer.h"

#include <map>
#include <string>

namespace quasilux {

struct RenderRecord {
    std::string version = QUASILUX_VERSION;
    std::string scene; ///< file name without its folder
    RenderSettings settings;
    StopRule stop;
    DeviceInfo device;
    unsigned workGroupSize = 0;
    SceneReport report;
    RenderCounters counters;
    ErrorEstimate error;
    MeterKind meter = MeterKind::none; ///< what the image's values are: radiance, or of area and grid irradiance
    std::map<std::string, KernelTiming> kernels;
    uint64_t peakBufferBytes = 0;             ///< buffers are allocated once and kept, so their sum is the peak
    double loadSeconds = 0, writeSeconds = 0; ///< reading the scene; writing the images
    bool interrupted = false;

    /// Emitted in each pass: what was asked for or, if that was left open, what was chosen.
    unsigned photonsPerPass() const { return report.photonsPerPass ? report.photonsPerPass : settings.photonsPerPass; }
};

} // namespace quasilux
