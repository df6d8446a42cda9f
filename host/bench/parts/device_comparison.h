// The same work on each device: rates, compile times cold and warm, energy, and how far images differ.
#pragma once

#include "bench/bench_section.h"
#include "bench/parts/part_scene.h"

#include <optional>

namespace quasilux {

/// Of two images of the same passes: they differ by rounding only, until it turns a path another way.
struct SamePassDifference {
    double mean = 0;    ///< of mean luminance, relative
    double rms = 0;     ///< relative, the root of relMSE
    double ofNoise = 0; ///< rms over that of the noise of one image

    static constexpr double meanTolerance = 1e-3, noiseTolerance = 0.1;
    bool isWithin() const;
};

struct DeviceResult {
    std::string scene;
    size_t device = 0;          ///< place in the list that was asked for
    PassMeasurement cold, warm; ///< with an empty cache of compiled kernels, and with the one that it left
    std::optional<SamePassDifference> difference; ///< to the first device
};

/// Of one scene, by device, in this order; the first one is the reference.
std::vector<DeviceResult> compareDevices(const PartScene& scene, const std::vector<int>& devices, double seconds,
                                         const OnStep& onStep);

/// "deviceComparison"
BenchSection deviceSection(const std::vector<DeviceResult>& all);

} // namespace quasilux
