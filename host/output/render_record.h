// What is known of a finished render: the headers of the images and the statistics file are made from it.
#pragma once

#include "auto/search_report.h"
#include "device/device.h"
#include "render/error_estimate.h"
#include "render/renderer.h"
#include "render/worker_record.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

/// How an image shows directions: what `quasilux dgp` needs to rate it.
struct ImageView {
    std::string projection;
    double degrees = 180; ///< that the image's width spans
};
/// Of a camera that looks through the middle of its film; none of another sensor, and of a crop window.
std::optional<ImageView> imageViewOf(const Sensor& sensor);

struct RenderRecord {
    std::string version = QUASILUX_VERSION;
    std::string scene; ///< file name without its folder
    RenderSettings settings;
    StopRule stop;
    DeviceInfo device;
    unsigned workGroupSize = 0;
    SceneReport report;
    RenderCounters counters;
    std::optional<GatheredCount> gathered; ///< which photons of a pass camera paths gather
    SearchReport search;                   ///< which settings were searched, and why these were chosen
    ErrorEstimate error;
    PixelFormat pixelFormat; ///< what the image holds beside R, G, B
    std::optional<ImageView> view;
    bool isPerNanometre = false;        ///< surroundings are in W per nanometre, of which 683 lm/W makes no lux
    MeterKind meter = MeterKind::none;  ///< what the image's values are: radiance, or of area and grid irradiance
    std::vector<IlluminanceGrid> grids; ///< whose points the image has one after the other, where the file has them
    std::optional<double> unobstructedIlluminance; ///< lx, of which illuminances are stated as daylight factors too
    std::map<std::string, KernelTiming> kernels;
    std::vector<WorkerRecord> workers;        ///< that shared its passes; empty: one device had them all
    uint64_t peakBufferBytes = 0;             ///< most that were in use at once, of all candidates
    uint64_t peakHostBytes = 0;               ///< of the process, until the images are written
    double loadSeconds = 0, writeSeconds = 0; ///< reading the scene; writing the images
    bool interrupted = false;
    std::string failure; ///< what ended it too early; empty: nothing

    /// Calls `visit(key, value)` for each setting that headers of images and of tables state; values are strings,
    /// unsigned, double, and uint64_t for what may need 64 bits.
    template <typename Visit>
    void forEachSetting(const Visit& visit) const {
        visit("scene", scene);
        visit("device", device.name);
        visit("driver", device.driver);
        visit("bdd", settings.bdd);
        visit("variant", name(settings.variant));
        visit("direct", name(settings.direct));
        visit("caustics", name(settings.caustics));
        visit("map", name(settings.map));
        visit("quasiSpecular", settings.quasiSpecular);
        visit("seed", settings.seed);
        visit("photonsPerPass", photonsPerPass());
        visit("cameraPaths", settings.cameraPaths);
        visit("cameraSampling", name(settings.cameraSampling));
        visit("radius", name(settings.radius));
        visit("radiusScale", settings.radiusScale);
        visit("auto", search.line());
        visit("passes", static_cast<unsigned>(counters.passes));
        visit("seconds", counters.renderSeconds);
        visit("nonFinite", counters.nonFinite);
    }

    /// Of radiance and irradiance.
    const char* units() const {
        if (settings.photometric) return "photometric";
        return isPerNanometre ? "radiometric per nanometre" : "radiometric";
    }
    /// Emitted in each pass: what was asked for or, if that was left open, what was chosen.
    unsigned photonsPerPass() const { return report.photonsPerPass ? report.photonsPerPass : settings.photonsPerPass; }
};

} // namespace quasilux
