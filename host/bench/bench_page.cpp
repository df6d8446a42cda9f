// The page of a benchmark: plots of error over time, pictures at equal time, tables.
#include "bench/bench_report.h"
#include "bench/svg_plot.h"
#include "output/png.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr const char* style = R"(img { width: 256px; }
table { display: block; overflow-x: auto; }
svg { max-width: 100%; background: #fff; font: 12px system-ui, sans-serif; margin: 0 12px 12px 0; }
svg .grid { stroke: #ddd; } svg .title { font-size: 14px; font-weight: 600; }
)";

std::string errorPlots(const BenchReport& report, const std::string& scene) {
    std::vector<PlotSeries> measured, estimated;
    for (const BenchRun* run : runsOf(report, scene)) {
        PlotSeries against{runTitle(report, *run), {}}, itself = against;
        for (const BenchPoint& point : run->points) {
            if (point.relMse) against.points.push_back({point.seconds, *point.relMse});
            itself.points.push_back({point.seconds, point.estimate.relativeMse()});
        }
        measured.push_back(against);
        estimated.push_back(itself);
    }
    std::string out;
    if (report.references.count(scene) > 0)
        out += logLogPlot({"error against the reference", "seconds", "relMSE, net of the reference's noise"}, measured);
    return out +
           logLogPlot({"error as the renders estimate it", "seconds", "relMSE: noise and bias, estimated"}, estimated);
}

/// All images of a scene with the tone curve of its first run.
std::string pictures(const BenchReport& report, const std::string& scene) {
    std::optional<ToneCurve> curve;
    std::string images, errors;
    const auto reference = report.references.find(scene);
    for (const BenchRun* run : runsOf(report, scene)) {
        const FilmImage& image = run->image;
        if (!curve) curve = chooseToneCurve(image, {});
        const std::string caption = fmt::format("{}, {} passes", runTitle(report, *run), run->points.back().passes);
        images += htmlFigure(toneMap(image, *curve), image.width, image.height, caption);
        if (reference != report.references.end())
            errors += htmlFigure(signedPicture(radianceOf(image), reference->second.image), image.width, image.height,
                                 caption);
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

std::string sectionText(const BenchSection& section) {
    std::string out = fmt::format("<h2>{}</h2>\n", htmlEscaped(section.title));
    for (const BenchTable& table : section.tables) {
        out += fmt::format("<h3>{}</h3>\n", htmlEscaped(table.title)) + table.plot + htmlTable(table.rows);
        if (!table.note.empty()) out += fmt::format("<p>{}</p>\n", htmlEscaped(table.note));
    }
    return out;
}

} // namespace

std::string benchPage(const BenchReport& report) {
    std::string out = htmlHead("quasilux bench", style);
    out += fmt::format("<h1>quasilux {} bench</h1>\n<p>{:g} s a run{}; load average {:.1f} before, {:.1f} after.</p>\n",
                       QUASILUX_VERSION, report.seconds, report.interrupted ? ", interrupted" : "",
                       report.loadBefore[0], report.loadAfter[0]);
    for (const BenchFailure& failure : report.failures)
        out += fmt::format("<p>Not measured: {}: {}</p>\n", htmlEscaped(failure.what), htmlEscaped(failure.message));
    out += deviceList(report);
    for (const std::string& scene : scenesOf(report)) {
        out += fmt::format("<h2>{}</h2>\n", htmlEscaped(scene)) + errorPlots(report, scene);
        out += htmlTable(runRows(report, scene));
        out += "<p>Times with ~ are extrapolated as noise falls, by 1 / time.</p>\n";
        out += "<h3>Equal time</h3>\n" + pictures(report, scene);
        out += "<h3>Stages</h3>\n" + htmlTable(stageRows(report, scene));
        out += "<h3>Devices</h3>\n" + htmlTable(deviceRows(report, scene));
    }
    if (report.micro) out += microSection(*report.micro);
    for (const BenchSection& section : report.sections) out += sectionText(section);
    return out + "</body></html>\n";
}

} // namespace quasilux
