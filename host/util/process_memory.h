// Memory of this process, as the operating system counts it.
#pragma once

#include <cstdint>

namespace quasilux {

/// Bytes in physical memory now; 0 where the system does not report it.
uint64_t residentBytes();

/// The most that ever were.
uint64_t peakResidentBytes();

} // namespace quasilux
