// Energy that a device reports of itself.
#pragma once

#include "device/device.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace quasilux {

/// Of a CPU: RAPL, the sum over all packages, which counts whatever else runs on them. Of an NVIDIA GPU: NVML, found
/// by the device's name, the first of equal ones. Else nothing is reported.
class EnergyCounter {
public:
    /// `powercap` is where Linux shows RAPL.
    explicit EnergyCounter(const DeviceInfo& device, const std::filesystem::path& powercap = "/sys/class/powercap");
    ~EnergyCounter();
    EnergyCounter(EnergyCounter&&) noexcept;

    /// Since some moment in the past; counters that begin anew are followed. Nothing where the device does not report
    /// it.
    std::optional<double> joules();

    struct Source; ///< one way to read it

private:
    std::unique_ptr<Source> source_;
};

} // namespace quasilux
