// Seconds of a clock that only goes forward; since when does not matter.
#pragma once

#include <chrono>

namespace quasilux {

inline double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace quasilux
