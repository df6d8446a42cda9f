#include "python/rendered.h"

#include "cli/render_report.h"
#include "cli/render_warnings.h"
#include "cli/started_render.h"
#include "util/error.h"
#include "util/process_memory.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

// By the same declarations as the command line: one copy of names, ranges and defaults.
RenderOptions optionsOf(const std::vector<std::string>& arguments, const Scene& scene) {
    Options options;
    CLI::App app;
    declareOptions(app, options);
    std::vector<std::string> line(arguments.rbegin(), arguments.rend()); // as CLI11 takes them
    line.insert(line.end(), {"scene", "render"});
    try {
        app.parse(line);
    } catch (const CLI::ParseError& error) {
        throw InputError(error.what());
    }
    options.render.scene = scene.path;
    return options.render;
}

std::shared_ptr<const Rendered> render(const RenderOptions& options, const Scene& scene, double loadSeconds,
                                       const std::optional<double>& daylight, std::vector<std::string> warnings,
                                       RenderWatch& watch) {
    Device device = [&] {
        const DelayedSignals delayed;
        const auto devices = ownDevices(options);
        if (devices.size() > 1)
            throw InputError(fmt::format("device {}: names {} devices, expected one here; `quasilux render` shares "
                                         "passes among several",
                                         options.devices, devices.size()));
        return Device(devices.front(), options.workGroupSize, options.deviceMemory);
    }();
    watch.look();
    StartedRender started(options, device, scene);
    watch.look();
    AutoRender render =
        started.render([&](const Progress& progress) { watch.onProgress(progress); }, {}, watch.interrupted());
    if (render.image.passes == 0) {
        if (watch.interrupted()) return nullptr;
        throw std::runtime_error("no pass was rendered before the stop rule was reached");
    }
    auto rendered = std::make_shared<Rendered>();
    rendered->record = makeRecord(scene, started.stop(), device, render, watch.interrupted());
    rendered->record.loadSeconds = loadSeconds;
    rendered->record.unobstructedIlluminance = daylight;
    // What a failing device has rendered before is kept.
    if (!render.failure) rendered->layers = renderLayers(device, scene, render);
    rendered->record.peakHostBytes = peakResidentBytes();
    rendered->warnings = std::move(warnings);
    for (const auto& warning : started.warnings()) rendered->warnings.push_back(warning);
    const RenderRecord& record = rendered->record;
    for (auto& warning : renderWarnings(record.counters, record.report, render.image))
        rendered->warnings.push_back(std::move(warning));
    if (const std::string why = started.checkpointFailure(); !why.empty())
        rendered->warnings.push_back("no checkpoint of the last passes could be written: " + why);
    rendered->image = std::move(render.image);
    return rendered;
}

} // namespace

std::shared_ptr<const Rendered> renderScene(const LoadedScene& loaded, const std::vector<std::string>& arguments,
                                            bool measuresGrids, RenderWatch& watch) {
    const RenderOptions options = optionsOf(arguments, *loaded.scene);
    checkCheckpointOptions(options);
    std::vector<std::string> warnings;
    if (!measuresGrids && !options.daylightFactor)
        return render(options, *loaded.scene, loaded.loadSeconds, std::nullopt, {}, watch);
    Scene measured = *loaded.scene; // the one that was loaded stays as it is
    if (measuresGrids) useGridsAsSensor(measured);
    const auto daylight = skyOfDaylightFactor(options, measured, warnings);
    return render(options, measured, loaded.loadSeconds, daylight, std::move(warnings), watch);
}

} // namespace quasilux
