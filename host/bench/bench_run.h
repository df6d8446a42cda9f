// One render that is timed: error over time, what each stage costs, rates.
#pragma once

#include "bench/bench_method.h"
#include "compare/image_file.h"
#include "device/device.h"
#include "render/error_estimate.h"
#include "render/renderer.h"

#include <atomic>
#include <functional>
#include <optional>

namespace quasilux {

/// After so many passes. Time is that of the passes alone: neither preparing and compiling nor measuring counts.
struct BenchPoint {
    unsigned passes = 0;
    double seconds = 0;    ///< on the clock
    double cpuSeconds = 0; ///< of this process: on a CPU device, what other programs on the machine do not change
    ErrorEstimate estimate;
    std::optional<double> relMse; ///< against the reference, net of its noise
};

struct BenchRun {
    std::string scene, method;
    size_t device = 0; ///< place in the list that was asked for
    RenderSettings settings;
    std::vector<BenchPoint> points; ///< passes 4, 8, 16, … and the last one
    RenderCounters counters;
    std::map<std::string, KernelTiming> kernels;
    std::optional<double> joules; ///< of all passes, where the device reports them
    uint64_t peakBufferBytes = 0;
    uint64_t peakHostBytes = 0; ///< of the process, runs before this one included
    FilmImage image;
};

/// What relMSE is measured against.
struct BenchReference {
    RadianceImage image;
    double noise = 0; ///< relMSE that a right image has against it: its own, mostly (docs/method/accuracy.md)
};

/// As `quasilux compare` takes images.
RadianceImage radianceOf(const FilmImage& image);

/// Renders until `seconds` have passed on the clock, or `interrupted`; at least one pass. `reference` may be null.
/// `onProgress` gets the passes and the seconds so far.
BenchRun measureRun(int device, const Scene& scene, const BenchMethod& method, double seconds,
                    const BenchReference* reference, const std::function<void(unsigned, double)>& onProgress,
                    const std::atomic<bool>& interrupted);

/// relMSE ~ seconds^slope, by least squares in logarithms over the points from pass 16 on; nothing where fewer than
/// three have a positive error.
std::optional<double> convergenceSlope(const BenchRun& run);

/// Seconds until the root of relMSE falls below `relativeError`. Between points along a power law; beyond the last one
/// with `slope` -1, that of noise.
struct TimeToError {
    double seconds = 0;
    bool extrapolated = false;
};
std::optional<TimeToError> timeToError(const BenchRun& run, double relativeError);

} // namespace quasilux
