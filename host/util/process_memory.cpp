#include "util/process_memory.h"

#include <fstream>
#include <string>
#include <sys/resource.h>

namespace quasilux {

namespace {

/// A line such as "VmHWM:  1234 kB" of one of Linux' tables, in bytes; 0 where there is none.
uint64_t bytesIn(const char* table, const std::string& key) {
    std::ifstream lines(table);
    for (std::string word; lines >> word;) {
        uint64_t kibibytes = 0;
        if (word == key && lines >> kibibytes) return kibibytes * 1024;
    }
    return 0;
}

uint64_t statusBytes(const std::string& key) { return bytesIn("/proc/self/status", key); }
uint64_t machineBytes(const std::string& key) { return bytesIn("/proc/meminfo", key); }

} // namespace

uint64_t residentBytes() { return statusBytes("VmRSS:"); }

uint64_t dataBytes() { return statusBytes("VmData:"); }

uint64_t peakResidentBytes() {
    // getrusage also counts what the process was before exec: the parent's memory.
    if (const uint64_t peak = statusBytes("VmHWM:")) return peak;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

uint64_t availableMemory() { return machineBytes("MemAvailable:"); }

uint64_t totalMemory() { return machineBytes("MemTotal:"); }

} // namespace quasilux
