// What `quasilux doctor` looks at: what renders need of the computer.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

enum class Health { good, warning, problem }; ///< a warning: renders run, but not as well as they could

struct Finding {
    Health health = Health::good;
    std::string what, found;
    std::string advice; ///< empty where all is well
};

/// Runtimes of OpenCL as its loader finds them, and each device with a kernel that is compiled and run.
std::vector<Finding> checkDevices();
/// The folder where the runtime keeps kernels that it has compiled.
Finding checkKernelCache();
/// Embree and OpenImageIO.
std::vector<Finding> checkLibraries();
std::vector<Finding> checkMemory();
Finding checkTemporaryFolder();

} // namespace quasilux
