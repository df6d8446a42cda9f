// What libFuzzer calls: the target by the name after "fuzz_" in the program's own.
#include "fuzz/targets.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace {

quasilux::fuzz::Target target = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** argv) {
    const std::string name = std::filesystem::path((*argv)[0]).filename().string();
    const auto found = quasilux::fuzz::targets.find(name.substr(name.find('_') + 1));
    if (found == quasilux::fuzz::targets.end()) {
        std::fprintf(stderr, "%s: no such target\n", name.c_str());
        std::exit(2);
    }
    target = found->second;
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    target({reinterpret_cast<const char*>(data), size});
    return 0;
}
