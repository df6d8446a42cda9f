#include "device/runtime_check.h"

#include "device/program.h"
#include "util/error.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

constexpr const char* selfTestFile = "self_test.cl";
constexpr const char* selfTestSource = "__kernel void squares(__global uint* values, uint count) {\n"
                                       "    const uint i = get_global_id(0);\n"
                                       "    if (i < count) values[i] = i * i;\n"
                                       "}\n";
constexpr uint32_t selfTestItems = 1000;

VendorFile readVendorFile(const fs::path& path) {
    VendorFile file{path.string(), {}, {}};
    std::ifstream stream(path);
    std::getline(stream, file.library);
    file.library.erase(std::find_if(file.library.begin(), file.library.end(), [](char c) { return c <= ' '; }),
                       file.library.end());
    if (file.library.empty()) {
        file.problem = "it names no library";
    } else if (!dlopen(file.library.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
        file.problem = dlerror();
    } // never closed: LLVM within a runtime does not stand to be loaded a second time
    return file;
}

} // namespace

std::string vendorPlace() {
    const char* chosen = std::getenv("OCL_ICD_VENDORS");
    return chosen && *chosen ? chosen : "/etc/OpenCL/vendors";
}

std::vector<VendorFile> vendorFiles() {
    const fs::path place = vendorPlace();
    std::vector<fs::path> paths;
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored)) paths.push_back(place);
    for (const auto& entry : fs::directory_iterator(place, ignored))
        if (entry.path().extension() == ".icd") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<VendorFile> files;
    files.reserve(paths.size());
    for (const auto& path : paths) files.push_back(readVendorFile(path));
    return files;
}

double runSelfTest(int index) {
    const Stopwatch watch;
    Device device(index);
    const Program program(device, selfTestFile, "", {{selfTestFile, selfTestSource}});
    Buffer<uint32_t> values(device, selfTestItems, "self-test");
    program.kernel("squares").launch(selfTestItems, values, selfTestItems);
    const std::vector<uint32_t> squares = values.read();
    for (uint32_t i = 0; i < selfTestItems; ++i)
        if (squares[i] != i * i)
            throw DeviceError(
                fmt::format("device {} computes wrongly: the square of {} is {}", device.info().name, i, squares[i]));
    return watch.seconds();
}

} // namespace quasilux
