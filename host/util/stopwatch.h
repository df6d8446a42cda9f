// Time on the clock and of the processor.
#pragma once

#include <chrono>
#include <ctime>

namespace quasilux {

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    /// Of all threads of this program.
    double processorSeconds() const { return double(std::clock() - clock_) / CLOCKS_PER_SEC; }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::clock_t clock_ = std::clock();
};

} // namespace quasilux
