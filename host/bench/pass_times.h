// A renderer whose passes are timed one by one.
#pragma once

#include "bench/device_energy.h"
#include "device/device.h"
#include "render/renderer.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace quasilux {

/// Seconds that one pass takes.
struct PassTimes {
    double clock = 0;
    double cpu = 0; ///< of this process: on a CPU device, what other programs on the machine do not change
    std::map<std::string, double> kernels;     ///< on the clock, by the runtime's profiling counters
    std::map<std::string, double> kernelCosts; ///< of a CPU device their shares of `cpu`, else `kernels`
    std::optional<double> joules;              ///< that the device reports

    /// What counts where other programs may run: CPU seconds of a CPU device, else those on the clock.
    double cost(bool isCpu) const { return isCpu ? cpu : clock; }
};

class TimedRenderer {
public:
    TimedRenderer(int device, const Scene& scene, const RenderSettings& settings);

    /// Renders the pass of this number. The same number again is the same work again if the radius is fixed.
    PassTimes pass(unsigned number);

    Renderer& renderer() { return renderer_; }
    Device& device() { return device_; }

private:
    Device device_;
    Renderer renderer_;
    EnergyCounter energy_;
    std::map<std::string, double> kernelSeconds_; ///< so far
};

/// One pass, again and again.
struct PassMeasurement {
    double prepare = 0, compile = 0, firstPass = 0; ///< seconds; runtimes may compile in the first pass
    PassTimes least; ///< each figure the least of all passes but the first: what disturbs only ever adds
    uint64_t bufferBytes = 0;
    size_t triangles = 0;
    uint64_t photons = 0, cameraPaths = 0; ///< of a pass

    /// What compiling cost, wherever the runtime did it.
    double compiling() const { return compile + std::max(0.0, firstPass - least.clock); }
};

/// What a renderer with a first pass behind it says of itself; `least` is left open.
PassMeasurement measurementOf(TimedRenderer& timed);
/// Each figure the least of these; at least one.
PassTimes leastOf(const std::vector<PassTimes>& passes);

/// For `seconds`, but three passes besides the first one at least. By one radius for all pixels.
PassMeasurement measurePass(int device, const Scene& scene, RenderSettings settings, double seconds);

nlohmann::json passMeasurementJson(const PassMeasurement& measured);
PassMeasurement passMeasurementFromJson(const nlohmann::json& json);

} // namespace quasilux
