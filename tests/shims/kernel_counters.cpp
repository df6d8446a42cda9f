// Memory of the counters that scripts/coverage.py puts into kernels: a file, at an address that they know, so that all
// processes count in it. Linked where QUASILUX_KERNEL_COUNTERS names that file.
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

// As in scripts/coverage.py.
constexpr size_t address = 0x100000000000, size = 1 << 16;

bool mapCounters() {
    const int file = open(QUASILUX_KERNEL_COUNTERS, O_RDWR);
    void* const wanted = reinterpret_cast<void*>(address);
    const bool done =
        file >= 0 && mmap(wanted, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED_NOREPLACE, file, 0) == wanted;
    if (file >= 0) close(file);
    if (done) return true;
    std::perror("counters of kernels: " QUASILUX_KERNEL_COUNTERS);
    std::abort();
}

} // namespace

extern "C" {
extern const bool quasiluxKernelCounters;
const bool quasiluxKernelCounters = mapCounters();
}
