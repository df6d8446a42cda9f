// A limit on the memory that this process takes.
#pragma once

#include <cstdint>

namespace quasilux {

/// While it lives, allocations that would take more than `bytes` beyond what the process has now fail (std::bad_alloc),
/// those of libraries and other threads too. Where the system has no such limit, it has no effect. One at a time.
class MemoryLimit {
public:
    explicit MemoryLimit(uint64_t bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
    uint64_t before_ = 0;
    bool isSet_ = false;
};

} // namespace quasilux
