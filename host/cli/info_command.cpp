// Prints the scene report as text or as JSON.
#include "cli/commands.h"

#include "auto/candidates.h"
#include "cli/interrupt.h"
#include "cli/text_table.h"
#include "output/progress_line.h"
#include "output/statistics.h"
#include "util/messages.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

std::string orNone(const std::vector<std::string>& items) {
    return items.empty() ? "none" : fmt::format("{}", fmt::join(items, ", "));
}

void printGeometry(const SceneReport& report) {
    fmt::print("geometry: {} triangles, {} spheres, {} smooth patches, {} border segments\n", report.triangles,
               report.spheres, report.patches, report.borderSegments);
    if (report.instances > 0) fmt::print("instances: {}, of shapes that are there once\n", report.instances);
    fmt::print("features: {}\n", orNone(report.features));
    fmt::print("photon classes in use: {}\n", orNone(report.photonClasses));
    fmt::print("photons per pass: {}{}\n", report.photonsPerPass,
               report.photonParts == 1
                   ? ""
                   : fmt::format(", in {} parts, as the device has no room for all at once", report.photonParts));
}

void printEmitters(const SceneReport& report, bool photometric) {
    TextTable table({"emitter", "type", photometric ? "power (lm)" : "power (W)"});
    for (const auto& row : report.emitters) table.add({row.id, row.type, fmt::format("{:.6g}", row.power)});
    fmt::print("\n{}", table.text());
}

void printLobes(const SceneReport& report) {
    TextTable table({"bsdf", "lobe", "scattering", "why"});
    for (const auto& row : report.lobes) table.add({row.bsdf, row.lobe, row.scattering, row.why});
    fmt::print("\n{}", table.text());
}

std::string splitText(double level) {
    if (level == 0) return "quasi-specular";
    return std::isinf(level) ? "genuine diffuse" : fmt::format("level {:.3g} per sr", level);
}

void printMedia(const SceneReport& report) {
    if (report.media.empty()) return;
    TextTable table({"medium", "phase function", "first kernel (scene units)", "why"});
    for (const auto& row : report.media) {
        const std::string kernel =
            row.kernelHalfHeight > 0 ? fmt::format("{:.3g}, half height {:.3g}", row.kernelRadius, row.kernelHalfHeight)
                                     : fmt::format("ball of {:.3g}", row.kernelRadius);
        table.add({row.medium, splitText(row.level), kernel, row.why});
    }
    fmt::print("\n{}", table.text());
}

void printRadii(const SceneReport& report) {
    if (report.initialRadius.empty()) return;
    TextTable table({"photon class", "initial radius (scene units)"});
    for (const auto& [photonClass, radius] : report.initialRadius)
        table.add({photonClass, fmt::format("{:.6g}", radius)});
    fmt::print("\n{}", table.text());
}

// What `render` with the same options would search, and the first candidates it may try.
struct SearchPlan {
    Freedom freedom;
    std::string notSearched; // why not, or empty
    std::vector<std::string> candidates;
};

void printSearch(const SearchPlan& search) {
    const std::string& why = search.notSearched;
    fmt::print("\nauto: {}\n", why.empty() ? "searches " + text(search.freedom) : "nothing searched: " + why);
    if (!why.empty()) return;
    for (const auto& candidate : search.candidates) fmt::print("  {}\n", candidate);
}

void printEnergy(const std::optional<EnergyBalance>& energy, bool photometric) {
    if (!energy) return;
    const double net = energy->lost - energy->gained;
    TextTable table({"photons' flux in the trial pass", photometric ? "lm" : "W"});
    table.add({"emitted", fmt::format("{:.6g}", energy->emitted)});
    table.add({"absorbed", fmt::format("{:.6g}", energy->absorbed)});
    table.add({"escaped", fmt::format("{:.6g}", energy->escaped)});
    table.add({"beyond max_depth", fmt::format("{:.6g}", energy->beyondDepth)});
    table.add({"cut", fmt::format("{:.6g}", energy->cut)});
    table.add({"lost by chance, net", fmt::format("{:.6g}", net)});
    table.add({"imbalance / emitted", fmt::format("{:.2g}", energy->imbalance())});
    fmt::print("\n{}", table.text());
}

void printBuffers(const std::map<std::string, uint64_t>& buffers) {
    TextTable table({"buffer", "memory"});
    uint64_t sum = 0;
    for (const auto& [label, bytes] : buffers) {
        table.add({label, bytesText(bytes)});
        sum += bytes;
    }
    table.add({"sum", bytesText(sum)});
    fmt::print("\n{}", table.text());
}

void printMemory(const MemoryForecast& forecast) {
    TextTable table({"peak of a render, predicted", "memory"});
    table.add({"device buffers", bytesText(forecast.deviceBytes)});
    table.add({"host process", bytesText(forecast.hostPeakBytes)});
    fmt::print("\n{}", table.text());
}

void printWarnings(const std::vector<std::string>& warnings, const SceneOptions& options) {
    if (options.quiet) return;
    for (const auto& warning : warnings) printWarning(warning);
}

// The report of a render after a trial pass, as one JSON object and as text.
void printJson(const std::string& file, const RenderSettings& settings, const SearchPlan& search, const Device& device,
               const Renderer& renderer) {
    const nlohmann::json why =
        search.notSearched.empty() ? nlohmann::json(nullptr) : nlohmann::json(search.notSearched);
    const nlohmann::json output{
        {"version", QUASILUX_VERSION},
        {"scene", file},
        {"settings", settingsJson(settings)},
        {"auto", {{"notSearched", why}, {"searched", text(search.freedom)}, {"candidates", search.candidates}}},
        {"device", deviceJson(device.info())},
        {"sceneReport", sceneReportJson(renderer.report())},
        {"trialPass", countersJson(renderer.counters())}};
    fmt::print("{}\n", output.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void printText(const std::string& file, const RenderSettings& settings, const SearchPlan& search, const Device& device,
               const Renderer& renderer) {
    const SceneReport& report = renderer.report();
    fmt::print("scene: {}\ndevice: {}\n", file, device.info().name);
    fmt::print("map: {}, in a trial pass {} records, {}\n", name(settings.map), renderer.counters().storedPoints,
               bytesText(renderer.counters().storedBytes));
    printGeometry(report);
    printEmitters(report, settings.photometric);
    printLobes(report);
    printMedia(report);
    printRadii(report);
    printBuffers(report.bufferBytes);
    printMemory(report.forecast);
    printEnergy(renderer.counters().energy, settings.photometric);
    printSearch(search);
}

} // namespace

void infoCommand(const SceneOptions& options) {
    exitOnInterrupt();
    const Scene scene = loadScene(options.scene, options.parameters(), options.choice());
    printWarnings(scene.warnings, options);
    const Freedom freedom = options.freedom(scene);
    const RenderSettings settings = searchStart(options.settings(scene), scene, freedom, {});
    Device device(options.device, options.workGroupSize, options.deviceMemory);
    exitOnInterrupt();
    ProgressLine progress(stderr, !options.quiet);
    progress.update({.phase = "preparing"});
    Renderer renderer(device, scene, settings);
    progress.update({.phase = "trial pass"});
    renderer.renderPass(0); // what the map holds shows only then
    progress.clear();

    const SceneReport& report = renderer.report();
    printWarnings(report.warnings, options);
    const SearchPlan search{freedom, whyNotSearched(scene, settings, {}),
                            firstCandidates(freedom, settings, report.photonsPerPass, scene)};
    const std::string file = std::filesystem::path(options.scene).filename().string();
    if (options.json)
        printJson(file, settings, search, device, renderer);
    else if (!options.quiet)
        printText(file, settings, search, device, renderer);
}

} // namespace quasilux
