// One of those that share the passes of a render.
#pragma once

#include <cstdint>
#include <string>

namespace quasilux {

struct WorkerRecord {
    std::string name;    ///< such as "device 0 part 1 of 2"
    uint64_t passes = 0; ///< of the image
    double seconds = 0;  ///< that its passes took, also those that were lost
    std::string failure; ///< why it was dropped; empty: it was not
};

} // namespace quasilux
