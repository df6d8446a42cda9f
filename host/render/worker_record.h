// One of those that share the passes of a render.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace quasilux {

struct WorkerRecord {
    std::string name;                     ///< such as "device 0 part 1 of 2"
    uint64_t passes = 0;                  ///< of the image
    double seconds = 0;                   ///< that its passes took, also those that were lost
    double timed = 0, squaredSeconds = 0; ///< those passes, and the sum of the squares of their seconds
    /// Standard deviation of a pass's seconds, relative to their mean.
    double spread() const {
        const double mean = timed > 0 ? seconds / timed : 0;
        return mean > 0 ? std::sqrt(std::max(0.0, squaredSeconds / timed / (mean * mean) - 1)) : 0;
    }
    std::string failure; ///< why it was dropped; empty: it was not
};

} // namespace quasilux
