// The single parts of the micro-benchmarks; each appends its rows.
#pragma once

#include "bench/micro/micro_bench.h"

namespace quasilux {

/// What every part is given.
struct MicroRun {
    const MicroSettings& settings;
    MicroReport& report;
    const MicroProgress& progress;
    const std::atomic<bool>& interrupted;
    std::vector<unsigned>
        threads; ///< compute units to use, one round of cases for each; 0 = a whole device that is no CPU
};

void benchTraversal(const MicroRun& run);
void benchMap(const MicroRun& run);
void benchGather(const MicroRun& run);
void benchSamplers(const MicroRun& run);
void benchTree(const MicroRun& run);

} // namespace quasilux
