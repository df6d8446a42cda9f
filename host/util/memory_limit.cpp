#include "util/memory_limit.h"

#include "util/process_memory.h"

#include <algorithm>
#include <sys/resource.h>

namespace quasilux {

// Linux counts writable memory that belongs to the process alone towards RLIMIT_DATA, whether or not it is touched.
MemoryLimit::MemoryLimit(uint64_t bytes) {
    rlimit limit{};
    const uint64_t now = dataBytes();
    if (now == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
    before_ = limit.rlim_cur;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, now + bytes);
    isSet_ = setrlimit(RLIMIT_DATA, &limit) == 0;
}

MemoryLimit::~MemoryLimit() {
    rlimit limit{};
    if (!isSet_ || getrlimit(RLIMIT_DATA, &limit) != 0) return;
    limit.rlim_cur = before_;
    setrlimit(RLIMIT_DATA, &limit);
}

} // namespace quasilux
