// Several ways to do the same work, timed in turns.
#pragma once

#include "device/device.h"

#include <functional>
#include <string>
#include <vector>

namespace quasilux {

struct TimedWay {
    std::string name;
    std::function<void()> run; ///< returns when all is done
    double seconds = 0;        ///< best round: processor time on CPU devices, so that other programs disturb it less
    std::function<void()> prepare = [] {}; ///< before each run, not timed
};

/// Runs all of them once unmeasured (kernels are compiled and caches warm then), then `rounds` times in turns. On a GPU
/// clock time is taken.
void timeInTurns(std::vector<TimedWay>& ways, unsigned rounds, const DeviceInfo& device);

/// Calls `work(begin, end)` on so many threads until all of `count` is done. Threads flush denormal numbers to zero, as
/// Embree advises.
void onThreads(unsigned threads, size_t count, const std::function<void(size_t, size_t)>& work);

} // namespace quasilux
