#include "util/process_memory.h"

#include <fstream>
#include <string>
#include <sys/resource.h>

namespace quasilux {

namespace {

/// A line such as "VmHWM:  1234 kB" of Linux' table of the process, in bytes; 0 where there is none.
uint64_t statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        uint64_t kibibytes = 0;
        if (word == key && status >> kibibytes) return kibibytes * 1024;
    }
    return 0;
}

} // namespace

uint64_t residentBytes() { return statusBytes("VmRSS:"); }

uint64_t peakResidentBytes() {
    // getrusage also counts what the process was before exec: the parent's memory.
    if (const uint64_t peak = statusBytes("VmHWM:")) return peak;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace quasilux
