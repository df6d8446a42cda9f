#include "cli/render_report.h"

#include "output/meter_reading.h"
#include "scene/skies/daylight_factor.h"
#include "util/error.h"
#include "util/process_memory.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

// Photons of caustics that a pixel of a meter needs for its standard error to mean anything.
constexpr uint64_t causticsPerPixel = 30;

void addWarningsOfCounters(const RenderCounters& counters, uint64_t pixels, std::vector<std::string>& warnings) {
    if (counters.nonFinite > 0)
        warnings.push_back(fmt::format("{} samples were not finite and were dropped, the image lacks their light",
                                       counters.nonFinite));
    if (counters.overflows > 0)
        warnings.push_back(fmt::format(
            "{} sums of splats left their range: the image is wrong there, use --map photons", counters.overflows));
    if (counters.clipped > 0)
        warnings.push_back(
            fmt::format("{} photons carried more flux than can be stored and were cut to that: the image lacks "
                        "the rest",
                        counters.clipped));
    if (counters.meterCaustics && *counters.meterCaustics < causticsPerPixel * pixels)
        warnings.push_back(
            fmt::format("{} photons of caustics have hit the meter's {} pixels: too few to estimate that light or "
                        "its error; use a larger meter or cells, more --photons or passes, or, for "
                        "quasi-caustics, --variant alternative",
                        *counters.meterCaustics, pixels));
    if (counters.cutPaths > 0)
        warnings.push_back(fmt::format(
            "{} paths were cut by the limit on events, with {:.3g} % of the flux and {:.3g} % of the "
            "camera paths' throughput",
            counters.cutPaths, counters.fluxEmitted > 0 ? 100 * counters.fluxCut / counters.fluxEmitted : 0.0,
            counters.cameraPaths > 0 ? 100 * counters.throughputCut / static_cast<double>(counters.cameraPaths) : 0.0));
}

// Light that so few photons have brought is not known, nor its noise; less than this share of the image hardly matters.
constexpr double fewestEffectivePhotons = 100, lightThatMatters = 0.01;

std::optional<std::string> warningOfRarePhotons(const RenderRecord& record) {
    const auto& learned = record.report.learned;
    if (!learned.effectivePhotons || learned.lightOfPhotons < lightThatMatters) return std::nullopt;
    const double effective = *learned.effectivePhotons * static_cast<double>(record.counters.passes);
    if (effective >= fewestEffectivePhotons) return std::nullopt;
    return fmt::format("{:.2g} % of the image's light comes from photons, but effectively only {:.2g} photons "
                       "contribute: too few to estimate that light or its error; render longer, use more --photons, "
                       "or follow such paths from the camera (--bdd 1, or --quasi-specular all --variant alternative)",
                       100 * learned.lightOfPhotons, effective);
}

} // namespace

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
    record.meter = scene.sensor.meter;
    record.pixelFormat = scene.sensor.pixelFormat;
    record.peakBufferBytes = render.peakBufferBytes;
    record.peakHostBytes = peakResidentBytes();
    record.interrupted = interrupted;
    if (render.failure) record.failure = failureOf([&] { std::rethrow_exception(render.failure); }).value_or("");
    const auto lost = failureOf([&] { record.kernels = device.timings(); });
    if (lost && record.failure.empty()) record.failure = *lost;
    return record;
}

std::vector<AovImage> renderLayers(Device& device, const Scene& scene, const AutoRender& render) {
    return renderAovs(device, scene, render.settings, std::min(render.image.passes, 256u));
}

std::vector<std::string> warningsOf(const RenderRecord& record, const FilmImage& image) {
    std::vector<std::string> warnings;
    addWarningsOfCounters(record.counters, uint64_t{image.width} * image.height, warnings);
    if (auto warning = warningOfRarePhotons(record)) warnings.push_back(std::move(*warning));
    return warnings;
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
