// The page of a benchmark: plots of error over time, pictures at equal time, tables.
#include "bench/bench_report.h"
#include "bench/svg_plot.h"
#include "compare/error_picture.h"
#include "output/png.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>quasilux bench</title><style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 24px; color: #222; background: #fafafa; }
figure { display: inline-block; margin: 0 16px 16px 0; vertical-align: top; width: min-content; }
img { image-rendering: pixelated; width: 256px; display: block; }
table { border-collapse: collapse; margin: 12px 0; display: block; overflow-x: auto; }
td, th { padding: 3px 12px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td:first-child, th:first-child { text-align: left; }
svg { max-width: 100%; background: #fff; font: 12px system-ui, sans-serif; margin: 0 12px 12px 0; }
svg .grid { stroke: #ddd; } svg .title { font-size: 14px; font-weight: 600; }
</style></head><body>
)";

std::string seriesName(const BenchReport& report, const BenchRun& run) {
    return report.devices.size() > 1 ? fmt::format("{}, device {}", run.method, run.device) : run.method;
}

std::string errorPlots(const BenchReport& report, const std::string& scene) {
    std::vector<PlotSeries> measured, told;
    for (const BenchRun& run : report.runs) {
        if (run.scene != scene) continue;
        PlotSeries against{seriesName(report, run), {}}, itself = against;
        for (const BenchPoint& point : run.points) {
            if (point.relMse) against.points.push_back({point.seconds, *point.relMse});
            itself.points.push_back({point.seconds, point.estimate.relativeMse()});
        }
        measured.push_back(against);
        told.push_back(itself);
    }
    std::string out;
    if (report.references.count(scene) > 0)
        out += logLogPlot({"error against the reference", "seconds", "relMSE, net of the reference's noise"}, measured);
    return out + logLogPlot({"error as the renders tell it", "seconds", "relMSE: noise and bias, told"}, told);
}

std::string figure(const std::string& caption, const Picture& picture, unsigned width, unsigned height) {
    return fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                       htmlEscaped(caption), pngDataUri(picture, width, height));
}

/// All images of a scene with the tone curve of its first run.
std::string pictures(const BenchReport& report, const std::string& scene) {
    std::optional<ToneCurve> curve;
    std::string images, errors;
    const auto reference = report.references.find(scene);
    for (const BenchRun& run : report.runs) {
        if (run.scene != scene || run.image.radiance.empty()) continue;
        if (!curve) curve = chooseToneCurve(run.image, {});
        const std::string caption = fmt::format("{}, {} passes", seriesName(report, run), run.points.back().passes);
        images += figure(caption, toneMap(run.image, *curve), run.image.width, run.image.height);
        if (reference != report.references.end())
            errors += figure(caption, signedPicture(radianceOf(run.image), reference->second.image), run.image.width,
                             run.image.height);
    }
    if (!errors.empty())
        errors =
            fmt::format("<p>Relative difference of luminance from the reference: blue -{0:g} %, white 0, red +{0:g} "
                        "%.</p>\n{1}",
                        100 * signedScale, errors);
    return images + errors;
}

std::string deviceList(const BenchReport& report) {
    std::vector<TableRow> rows{{"device", "name", "platform", "version", "driver", "compute units"}};
    for (size_t k = 0; k < report.devices.size(); ++k) {
        const DeviceInfo& device = report.devices[k];
        rows.push_back({std::to_string(k), device.name, device.platform, device.version, device.driver,
                        std::to_string(device.computeUnits)});
    }
    return htmlTable(rows);
}

} // namespace

std::string benchPage(const BenchReport& report) {
    std::string out = head;
    out += fmt::format("<h1>quasilux {} bench</h1>\n<p>{:g} s a run{}; load average {:.1f} before, {:.1f} after.</p>\n",
                       QUASILUX_VERSION, report.seconds, report.interrupted ? ", interrupted" : "",
                       report.loadBefore[0], report.loadAfter[0]);
    out += deviceList(report);
    for (const std::string& scene : scenesOf(report)) {
        out += fmt::format("<h2>{}</h2>\n", htmlEscaped(scene)) + errorPlots(report, scene);
        out += htmlTable(runRows(report, scene));
        out += "<p>Times with ~ are extrapolated as noise falls, by 1 / time.</p>\n";
        out += "<h3>Equal time</h3>\n" + pictures(report, scene);
        out += "<h3>Stages</h3>\n" + htmlTable(stageRows(report, scene));
        out += "<h3>Devices</h3>\n" + htmlTable(deviceRows(report, scene));
    }
    return out + "</body></html>\n";
}

} // namespace quasilux
