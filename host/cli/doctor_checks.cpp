#include "cli/doctor_checks.h"

#include "cli/text_table.h"
#include "device/device.h"
#include "device/runtime_check.h"
#include "prepare/embree_version.h"
#include "util/error.h"
#include "util/nameless_file.h"
#include "util/process_memory.h"
#include "util/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

constexpr const char* installRuntime = "install a runtime, such as Debian's package pocl-opencl-icd for the CPU";
constexpr uint64_t littleMemory = uint64_t{2} << 30, littleSpace = uint64_t{100} << 20;

std::vector<Finding> checkVendorFiles() {
    std::vector<Finding> findings;
    for (const VendorFile& file : vendorFiles()) {
        const std::string what = "OpenCL runtime " + file.path;
        if (file.problem.empty())
            findings.push_back({Health::good, what, file.library, ""});
        else
            findings.push_back({Health::problem, what, fmt::format("cannot be loaded: {}", file.problem),
                                "install the package that this file belongs to anew, or remove the file"});
    }
    if (findings.empty())
        findings.push_back({Health::problem, "OpenCL runtimes", fmt::format("none in {}", vendorPlace()),
                            std::getenv("OCL_ICD_VENDORS") ? "OCL_ICD_VENDORS is set: unset it, or point it to a "
                                                             "folder with .icd files"
                                                           : installRuntime});
    return findings;
}

// "OpenCL 1.2 pocl" is at least 1.2.
bool isVersionEnough(const std::string& version) {
    std::istringstream stream(version.substr(std::min(version.size(), std::string("OpenCL ").size())));
    double number = 0;
    stream >> number;
    return number >= 1.2;
}

Finding checkDevice(size_t number, const DeviceInfo& info) {
    Finding finding{Health::good, fmt::format("device {}, {}", number, info.name), "", ""};
    const std::string description = fmt::format("{}, {}", info.version, bytesText(info.globalMemory));
    if (!isVersionEnough(info.version)) {
        finding.health = Health::warning;
        finding.found = description;
        finding.advice = "OpenCL C 1.2 is needed: use another device (--device N), or a newer driver";
        return finding;
    }
    double seconds = 0;
    if (const auto why = failureOf([&] { seconds = runSelfTest(static_cast<int>(number)); })) {
        finding.health = Health::problem;
        finding.found = fmt::format("{}; a small kernel failed: {}", description, *why);
        finding.advice = "install the driver anew, or use another device (--device N)";
    } else {
        finding.found = fmt::format("{}; a small kernel was compiled and run in {:.2f} s", description, seconds);
    }
    return finding;
}

// Where PoCL 3.1 keeps compiled kernels.
fs::path cacheFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string chosen = variable("POCL_CACHE_DIR"); !chosen.empty()) return chosen;
    if (const std::string caches = variable("XDG_CACHE_HOME"); !caches.empty())
        return fs::path(caches) / "pocl" / "kcache";
    if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "pocl" / "kcache";
    return "/tmp/pocl/kcache";
}

// Whether files can be made in the folder, or it can be made itself; tried, since permissions alone do not tell.
bool isWritable(fs::path folder) {
    std::error_code ignored;
    while (!fs::exists(folder, ignored) && folder.has_parent_path() && folder != folder.parent_path())
        folder = folder.parent_path();
    if (!fs::is_directory(folder, ignored)) return false;
    const int file = openNamelessFile(folder);
    if (file < 0) return false;
    close(file);
    return true;
}

} // namespace

std::vector<Finding> checkDevices() {
    std::vector<Finding> findings = checkVendorFiles();
    std::vector<DeviceInfo> devices;
    if (const auto why = failureOf([&] { devices = listDevices(); })) {
        findings.push_back({Health::problem, "OpenCL devices", *why, "a runtime fails: restart, or reinstall it"});
        return findings;
    }
    for (size_t number = 0; number < devices.size(); ++number) findings.push_back(checkDevice(number, devices[number]));
    const bool hasRuntime =
        std::any_of(findings.begin(), findings.end(), [](const Finding& one) { return one.health == Health::good; });
    if (devices.empty())
        findings.push_back({Health::problem, "OpenCL devices", "none",
                            hasRuntime ? "a runtime is there but offers none: see what else is wrong here; of a GPU, "
                                         "its driver and whether this user may open it"
                                       : installRuntime});
    return findings;
}

Finding checkKernelCache() {
    const fs::path folder = cacheFolder();
    Finding finding{Health::good, "kernels compiled by PoCL", folder.string(), ""};
    std::error_code unknown;
    const fs::path root = fs::exists(folder, unknown) ? folder : fs::path("/");
    const fs::space_info space = fs::space(root, unknown);
    if (!isWritable(folder)) {
        finding.health = Health::problem; // PoCL 3.1 has no devices then
        finding.found += " cannot be written";
        finding.advice = "make the folder writable, or let POCL_CACHE_DIR name another one: without it PoCL offers no "
                         "devices";
    } else if (!unknown && space.available < littleSpace) {
        finding.health = Health::warning;
        finding.found += fmt::format(" has {} left", bytesText(space.available));
        finding.advice = "make room; what the folder holds may be removed";
    }
    return finding;
}

std::vector<Finding> checkLibraries() {
    std::vector<Finding> findings;
    if (const std::string version = embreeVersion(); version.empty())
        findings.push_back({Health::problem, "Embree", "does not start", "install Debian's package libembree3-3 anew"});
    else
        findings.push_back({Health::good, "Embree", version, ""});
    const int version = OIIO::openimageio_version();
    Finding images{Health::good, "OpenImageIO",
                   fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100), ""};
    if (!OIIO::ImageOutput::create("image.exr") || !OIIO::ImageOutput::create("image.png")) {
        images.health = Health::problem;
        images.found += " cannot write OpenEXR or PNG";
        images.advice = "install one that was built with both, such as Debian's libopenimageio2.4";
    }
    findings.push_back(images);
    return findings;
}

std::vector<Finding> checkMemory() {
    std::vector<Finding> findings;
    if (const uint64_t free = availableMemory(); free > 0) {
        Finding memory{Health::good, "memory", fmt::format("{} free of {}", bytesText(free), bytesText(totalMemory())),
                       ""};
        if (free < littleMemory) {
            memory.health = Health::warning;
            memory.advice = "large scenes and films need more: end other programs; `quasilux info SCENE` says how much";
        }
        findings.push_back(memory);
    }
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        findings.push_back({Health::warning, "limit on memory", bytesText(limit.rlim_cur),
                            "`ulimit -v unlimited` lifts it: runtimes of OpenCL reserve more than they use"});
    return findings;
}

Finding checkTemporaryFolder() {
    Finding finding{Health::good, "temporary folder", "", ""};
    std::error_code unknown;
    finding.found = fs::temp_directory_path(unknown).string();
    if (failureOf([] { const TemporaryFolder made; })) {
        finding.health = Health::problem;
        finding.found += " cannot be written";
        finding.advice = "runtimes compile there: make it writable, or let TMPDIR name another folder";
    }
    return finding;
}

} // namespace quasilux
