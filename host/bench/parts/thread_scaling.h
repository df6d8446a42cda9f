// What more threads of a CPU device buy, kernel by kernel.
#pragma once

#include "bench/bench_section.h"
#include "bench/parts/paired_ratio.h"
#include "bench/parts/part_scene.h"

#include <atomic>

namespace quasilux {

/// A pass with 1, 2, 4, … threads, up to the device's compute units.
struct ThreadScaling {
    std::string scene;
    size_t device = 0; ///< place in the list that was asked for
    std::vector<unsigned> threads;
    std::vector<PassMeasurement> least;                 ///< by number of threads, the least of all rounds
    std::vector<std::map<std::string, double>> speedUp; ///< of the least, by number of threads: "pass" and kernels
    std::vector<PairedRatio> rounds;                    ///< of whole passes, of each round on its own
};

/// Each number of threads in a process of its own, by turns: a runtime takes it from its environment when it starts.
/// Threads empty where the device is not a CPU.
ThreadScaling measureThreads(const PartScene& scene, int device, double seconds, const OnStep& onStep,
                             const std::atomic<bool>& interrupted);

/// "threads"
BenchSection threadSection(const std::vector<ThreadScaling>& all);

} // namespace quasilux
