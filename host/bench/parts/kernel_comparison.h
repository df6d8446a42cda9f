// What compiling kernels for one scene buys, against kernels with every feature.
#pragma once

#include "bench/bench_section.h"
#include "bench/parts/paired_ratio.h"
#include "bench/parts/part_scene.h"

#include <atomic>

namespace quasilux {

/// Generic over specialised: above 1 specialisation pays.
struct KernelComparison {
    std::string scene;
    size_t device = 0; ///< place in the list that was asked for
    bool isCpu = true;
    size_t pairs = 0;
    PairedRatio pass;
    std::map<std::string, PairedRatio> kernels;
    PassMeasurement specialised, generic; ///< the least of the passes, and what comes before them
};

/// Passes of both by turns, the same pass of each, until both together have taken `seconds`; four pairs at least.
KernelComparison compareKernels(const PartScene& scene, int device, double seconds,
                                const std::atomic<bool>& interrupted);

/// "kernels"
BenchSection kernelSection(const std::vector<KernelComparison>& all);

} // namespace quasilux
