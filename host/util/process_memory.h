// Memory of this process and of the machine, as the operating system counts it.
#pragma once

#include <cstdint>

namespace quasilux {

/// Bytes in physical memory now; 0 where the system does not report it.
uint64_t residentBytes();

/// Of data, whether touched or not; 0 likewise.
uint64_t dataBytes();

/// The most that ever were.
uint64_t peakResidentBytes();

/// Of the machine: what there is for further programs, and all; 0 where the system does not report it.
uint64_t availableMemory();
uint64_t totalMemory();

} // namespace quasilux
