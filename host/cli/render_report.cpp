#include "cli/render_report.h"

#include "output/meter_reading.h"
#include "scene/skies/daylight_factor.h"
#include "util/error.h"
#include "util/process_memory.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

RenderRecord makeRecord(const Scene& scene, const StopRule& stop, Device& device, const AutoRender& render,
                        bool interrupted) {
    RenderRecord record;
    record.scene = std::filesystem::path(scene.path).filename().string();
    record.settings = render.settings;
    record.stop = stop;
    record.device = device.info();
    record.workGroupSize = device.workGroupSize();
    record.report = render.report;
    record.counters = render.counters;
    record.gathered = render.gathered;
    record.search = render.search;
    record.error = estimateError(render.image);
    record.isPerNanometre = scene.surroundings && scene.surroundings->isPerNanometre;
    record.meter = scene.sensor.meter;
    if (record.meter == MeterKind::grid) record.grids = scene.grids;
    for (IlluminanceGrid& grid : record.grids) grid.origin += scene.origin;
    record.view = imageViewOf(scene.sensor);
    record.pixelFormat = scene.sensor.pixelFormat;
    record.peakBufferBytes = render.peakBufferBytes;
    record.peakHostBytes = peakResidentBytes();
    record.interrupted = interrupted;
    if (render.failure) record.failure = failureOf([&] { std::rethrow_exception(render.failure); }).value_or("");
    record.workers = render.workers;
    const auto lost = failureOf([&] { record.kernels = render.timings ? *render.timings : device.timings(); });
    if (lost && record.failure.empty()) record.failure = *lost;
    return record;
}

std::vector<AovImage> renderLayers(Device& device, const Scene& scene, const AutoRender& render) {
    return renderAovs(device, scene, render.settings, aovSamples(render.image.passes));
}

std::optional<double> skyOfDaylightFactor(const RenderOptions& options, Scene& scene,
                                          std::vector<std::string>& warnings) {
    if (!options.daylightFactor) return std::nullopt;
    if (!isIrradiance(scene.sensor.meter))
        throw InputError(scene.sensor.where,
                         "--daylight-factor is of points or surfaces: give --grid FILE, or a sensor "
                         "'irradiancemeter'.");
    const SkyAlone sky = keepSkyAlone(scene);
    if (sky.leftOut > 0)
        warnings.push_back(fmt::format("--daylight-factor: {} emitters besides the sky are left out", sky.leftOut));
    const glm::dvec3& irradiance = sky.groundIrradiance;
    return photometric({irradiance.x, irradiance.y, irradiance.z}, options.settings(scene).photometric);
}

} // namespace quasilux
