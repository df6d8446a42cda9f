#include "bench/micro/contest.h"

#include "util/stopwatch.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace quasilux {

namespace {

void flushDenormals() {
#ifdef __SSE__
    constexpr unsigned flushToZero = 0x8000, denormalsAreZero = 0x0040;
    _mm_setcsr(_mm_getcsr() | flushToZero | denormalsAreZero);
#endif
}

} // namespace

void timeInTurns(std::vector<TimedWay>& ways, unsigned rounds, const DeviceInfo& device) {
    for (TimedWay& way : ways) {
        way.prepare();
        way.run();
        way.seconds = std::numeric_limits<double>::infinity();
    }
    for (unsigned round = 0; round < rounds; ++round)
        for (TimedWay& way : ways) {
            way.prepare();
            const Stopwatch watch;
            way.run();
            way.seconds = std::min(way.seconds, device.isCpu ? watch.processorSeconds() : watch.seconds());
        }
}

void onThreads(unsigned threads, size_t count, const std::function<void(size_t, size_t)>& work) {
    constexpr size_t share = 2048;
    std::atomic<size_t> next{0};
    const auto labour = [&] {
        flushDenormals();
        for (size_t begin; (begin = next.fetch_add(share)) < count;) work(begin, std::min(count, begin + share));
    };
    std::vector<std::thread> workers;
    for (unsigned k = 0; k < threads; ++k) workers.emplace_back(labour);
    for (std::thread& worker : workers) worker.join();
}

} // namespace quasilux
