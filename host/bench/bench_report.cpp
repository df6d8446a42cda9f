// Tables and JSON; the page is in bench_page.cpp.
#include "bench/bench_report.h"

#include "compare/measures.h"
#include "output/statistics.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr double targets[] = {0.01, 0.001}; ///< relative errors whose time is reported

std::string percentText(double ratio) { return fmt::format("{:.3g} %", 100 * ratio); }

std::string timeText(const std::optional<TimeToError>& time) {
    if (!time) return "unknown";
    return fmt::format("{}{:.3g} s", time->extrapolated ? "~" : "", time->seconds);
}

double perSecond(uint64_t count, const BenchRun& run) { return static_cast<double>(count) / run.points.back().seconds; }

json pointJson(const BenchPoint& point) {
    return {{"passes", point.passes},
            {"seconds", point.seconds},
            {"cpuSeconds", point.cpuSeconds},
            {"relMse", point.relMse ? json(*point.relMse) : json()},
            {"error", errorJson(point.estimate)}};
}

json runJson(const BenchReport& report, const BenchRun& run) {
    json points = json::array(), kernels = json::object(), times = json::array();
    for (const BenchPoint& point : run.points) points.push_back(pointJson(point));
    for (const auto& [kernel, timing] : run.kernels) kernels[kernel] = timing.seconds;
    for (const double target : targets)
        if (const auto time = timeToError(run, target))
            times.push_back(
                {{"relativeError", target}, {"seconds", time->seconds}, {"extrapolated", time->extrapolated}});
    const auto slope = convergenceSlope(run);
    const auto difference = deviceDifference(report, run);
    return {{"scene", run.scene},
            {"method", run.method},
            {"device", run.device},
            {"settings", settingsJson(run.settings)},
            {"points", points},
            {"slope", slope ? json(*slope) : json()},
            {"timeToError", times},
            {"counters", countersJson(run.counters)},
            {"kernelSeconds", kernels},
            {"phases",
             {{"prepare", run.counters.prepareSeconds},
              {"compile", run.counters.compileSeconds},
              {"firstPass", run.counters.firstPassSeconds}}},
            {"peakBufferBytes", run.peakBufferBytes},
            {"peakHostBytes", run.peakHostBytes},
            {"joules", run.joules ? json(*run.joules) : json()},
            {"differenceToFirstDevice", difference ? json{{"mean", difference->mean},
                                                          {"meanStandardError", difference->meanStandardError},
                                                          {"beyondThreeStandardErrors", difference->beyondThree}}
                                                   : json()}};
}

} // namespace

std::vector<std::string> scenesOf(const BenchReport& report) {
    std::vector<std::string> scenes;
    for (const BenchRun& run : report.runs)
        if (std::find(scenes.begin(), scenes.end(), run.scene) == scenes.end()) scenes.push_back(run.scene);
    return scenes;
}

std::vector<const BenchRun*> runsOf(const BenchReport& report, const std::string& scene) {
    std::vector<const BenchRun*> runs;
    for (const BenchRun& run : report.runs)
        if (run.scene == scene) runs.push_back(&run);
    return runs;
}

std::string runTitle(const BenchReport& report, const BenchRun& run) {
    return report.devices.size() > 1 ? fmt::format("{}, device {}", run.method, run.device) : run.method;
}

std::optional<DeviceDifference> deviceDifference(const BenchReport& report, const BenchRun& run) {
    if (run.device == 0) return std::nullopt;
    const auto first = std::find_if(report.runs.begin(), report.runs.end(), [&](const BenchRun& other) {
        return other.device == 0 && other.scene == run.scene && other.method == run.method;
    });
    if (first == report.runs.end()) return std::nullopt;
    const auto comparison = compareImages(radianceOf(run.image), radianceOf(first->image),
                                          {wholePicture(run.image.width, run.image.height)}, {.worstPixels = 0});
    const RegionMeasures& whole = comparison.regions.at(0);
    return DeviceDifference{whole.relativeBias(), whole.standardErrorByPixels.value_or(0) / whole.referenceLuminance,
                            comparison.beyondThreeStandardErrors.value_or(0)};
}

std::vector<TableRow> runRows(const BenchReport& report, const std::string& scene) {
    std::vector<TableRow> rows{{"method", "device", "passes", "seconds", "CPU seconds", "relMSE", "estimated", "noise",
                                "bias", "slope", "to 1 %", "to 0.1 %", "stored a pass", "buffers"}};
    for (const BenchRun* run : runsOf(report, scene)) {
        const BenchPoint& last = run->points.back();
        const auto slope = convergenceSlope(*run);
        rows.push_back({run->method, std::to_string(run->device), std::to_string(last.passes),
                        fmt::format("{:.2f}", last.seconds), fmt::format("{:.2f}", last.cpuSeconds),
                        last.relMse ? fmt::format("{:.2e}", *last.relMse) : "no reference",
                        fmt::format("{:.2e}", last.estimate.relativeMse()), percentText(last.estimate.total.noiseRms),
                        last.estimate.hasBias ? percentText(last.estimate.total.biasRms) : "unknown",
                        slope ? fmt::format("{:.2f}", *slope) : "unknown", timeText(timeToError(*run, targets[0])),
                        timeText(timeToError(*run, targets[1])), std::to_string(run->counters.storedPoints),
                        fmt::format("{:.1f} MB", 1e-6 * double(run->peakBufferBytes))});
    }
    return rows;
}

std::vector<TableRow> stageRows(const BenchReport& report, const std::string& scene) {
    const auto runs = runsOf(report, scene);
    std::set<std::string> kernels;
    TableRow headings{"kernel, ms a pass"};
    for (const BenchRun* run : runs) {
        headings.push_back(runTitle(report, *run));
        for (const auto& [kernel, timing] : run->kernels) kernels.insert(kernel);
    }
    std::vector<TableRow> rows{headings};
    for (const std::string& kernel : kernels) {
        TableRow row{kernel};
        for (const BenchRun* run : runs) {
            const auto found = run->kernels.find(kernel);
            row.push_back(found == run->kernels.end()
                              ? ""
                              : fmt::format("{:.2f}", 1e3 * found->second.seconds / run->points.back().passes));
        }
        rows.push_back(row);
    }
    return rows;
}

std::vector<TableRow> deviceRows(const BenchReport& report, const std::string& scene) {
    std::vector<TableRow> rows{{"method", "device", "photons/s", "camera paths/s", "prepare", "compile", "first pass",
                                "mean against device 0", "beyond 3 standard errors"}};
    for (const BenchRun* run : runsOf(report, scene)) {
        const auto difference = deviceDifference(report, *run);
        rows.push_back({run->method, std::to_string(run->device),
                        fmt::format("{:.3g}", perSecond(run->counters.photonsEmitted, *run)),
                        fmt::format("{:.3g}", perSecond(run->counters.cameraPaths, *run)),
                        fmt::format("{:.2f} s", run->counters.prepareSeconds),
                        fmt::format("{:.2f} s", run->counters.compileSeconds),
                        fmt::format("{:.2f} s", run->counters.firstPassSeconds),
                        difference ? fmt::format("{:+.3f} % +- {:.3f} %", 100 * difference->mean,
                                                 100 * difference->meanStandardError)
                                   : "",
                        difference ? percentText(difference->beyondThree) : ""});
    }
    return rows;
}

json benchJson(const BenchReport& report) {
    json devices = json::array(), runs = json::array(), references = json::object();
    for (const DeviceInfo& device : report.devices) devices.push_back(deviceJson(device));
    for (const BenchRun& run : report.runs) runs.push_back(runJson(report, run));
    for (const auto& [scene, reference] : report.references)
        references[scene] = {{"file", reference.image.path}, {"noise", reference.noise}};
    json failures = json::array();
    for (const BenchFailure& failure : report.failures)
        failures.push_back({{"what", failure.what}, {"message", failure.message}});
    json all{{"version", QUASILUX_VERSION},
             {"secondsPerRun", report.seconds},
             {"interrupted", report.interrupted},
             {"loadBefore", report.loadBefore},
             {"loadAfter", report.loadAfter},
             {"devices", devices},
             {"references", references},
             {"runs", runs},
             {"failures", failures}};
    all["micro"] = report.micro ? microJson(*report.micro) : json();
    for (const BenchSection& section : report.sections) all[section.key] = section.figures;
    return all;
}

} // namespace quasilux
