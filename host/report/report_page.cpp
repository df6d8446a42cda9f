#include "report/report_page.h"

#include "compare/html_parts.h"
#include "photometry/isolux.h"
#include "photometry/photometry.h"
#include "report/figure_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t listedSources = 20; // of the luminaires that an observer sees

constexpr const char* style = R"(
body { max-width: 1060px; margin: 24px auto; padding: 0 16px; background: #fff; }
h1 { margin-bottom: 0; } h2 { margin-top: 36px; border-bottom: 2px solid #0072b2; padding-bottom: 4px; }
figure { width: auto; margin-bottom: 20px; break-inside: avoid; }
figure img { max-width: 100%; } figcaption { max-width: 560px; color: #555; font-size: 13px; }
svg { max-width: 100%; height: auto; }
section, table, tr { break-inside: avoid; } h2, h3 { break-after: avoid; }
td { vertical-align: top; } th { white-space: normal; vertical-align: bottom; } .note { color: #555; max-width: 760px; }
.warning { border-left: 4px solid #d55e00; padding: 2px 12px; max-width: 760px; }
.pictures { display: flex; flex-wrap: wrap; } .pictures img { width: 340px; } .pictures svg { width: 620px; }
.luminaire { display: flex; flex-wrap: wrap; gap: 24px; break-inside: avoid; } .luminaire svg { width: 360px; }
@page { size: A4; margin: 15mm; }
@media print { body { font-size: 11px; margin: 0; padding: 0; } td, th { padding: 2px 8px; } .luminaire svg { width: 300px; } .pictures img { width: 220px; } .pictures svg { width: 410px; } figcaption { font-size: 11px; } }
)";

std::string paragraph(const std::string& text, const char* kind = "note") {
    return fmt::format("<p class=\"{}\">{}</p>\n", kind, htmlEscaped(text));
}

std::string figure(const Drawing& drawing, const std::string& caption) {
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svgOf(drawing), htmlEscaped(caption));
}

std::string summary(const ReportContent& content) {
    const std::vector<TableRow> rows = figureRows(content);
    if (rows.size() < 2)
        return paragraph("The scene has no illuminance-grid and no observer, so there are no figures.");
    std::string out = htmlTable(rows);
    if (!content.isKnown())
        out += paragraph(
            fmt::format("Not every figure is known to {:g} % (95 %): render longer (--time).", 100 * content.precision),
            "warning");
    return out +
           paragraph(
               "Intervals hold with 95 % and are of the noise. The least of noisy points is lower than the points are, "
               "the greatest higher: the last "
               "column bounds what is to be added, by points that one half of the passes chose and the other half "
               "measured. What the density "
               "radius of the photon map adds at the second hit and later is not estimated for grids and observers.");
}

std::string pictures(const PicturePart& part) {
    const auto scale = [&](bool isLogarithmic) { return scaleOfImage(part.luminance, isLogarithmic); };
    std::string out = "<section><h2>Picture</h2>\n<div class=\"pictures\">\n";
    out += htmlFigure(part.toneMapped, part.luminance.width, part.luminance.height, "as the eye might see it");
    out += figure(falseColourDrawing(part.luminance, {ColourMap::viridis, scale(true)}, "luminance"),
                  "luminance, logarithmic scale") +
           "</div>\n";
    const ErrorEstimate& error = part.error;
    if (!std::isfinite(error.sum()))
        out += paragraph("Noise of a pixel: not estimated, the picture has too few passes; render longer. Bias of the "
                         "density radius: not "
                         "estimated.");
    else
        out +=
            paragraph(fmt::format("Noise of a pixel: {:.2g} % in the mean, 95 % of the pixels below {:.2g} %. Bias of "
                                  "the density radius: {}.",
                                  100 * error.total.noiseMean, 100 * error.total.noisePercentile95,
                                  error.hasBias ? fmt::format("{:.2g} % (root mean square)", 100 * error.total.biasRms)
                                                : std::string("not estimated")));
    return out + "</section>\n";
}

std::string pointsAgain(const GridPart& part) {
    if (part.pointsAgain == 0) return "";
    return fmt::format(
        " The {} points that may be the darkest or brightest were measured once more for the minimum, the "
        "maximum and their ratios: {} passes of all such points, {:.1f} s.",
        part.pointsAgain, part.again.passes, part.again.seconds);
}

std::string modellingOfPoints(const GridPart& part) {
    if (!part.modelling) return "";
    const PointModelling& points = part.modellingAtPoints;
    return paragraph(
        fmt::format("Modelling at single points: {:.2f} to {:.2f}; {} of {} points have 0.30 to 0.60, which "
                    "EN 12464-1 asks for.",
                    points.least, points.largest, points.within, points.points));
}

std::string grid(const GridPart& part, bool isAlone) {
    const ValueScale scale = scaleOfGrid(part.values, false);
    return fmt::format("<section><h2>{}{}</h2>\n", part.isCylindrical ? "Cylindrical illuminance" : "Illuminance",
                       isAlone ? "" : ": " + htmlEscaped(part.name)) +
           figure(isoluxDrawing(part.values, {ColourMap::viridis, scale}, {}, "isolux lines"),
                  "isolux lines; numbers: illuminance of the points in lx") +
           modellingOfPoints(part) +
           paragraph(fmt::format("{} passes, {:.1f} s.", part.passes, part.seconds) + pointsAgain(part)) +
           "</section>\n";
}

std::string sourceTable(const GlareSources& sources) {
    if (sources.seen.empty()) return paragraph("No luminaire is in sight, so nothing glares.");
    std::vector<TableRow> rows{{"luminaire", "luminance", "solid angle", "position index", "visible", "share"}};
    const double all = sources.strength();
    for (size_t k = 0; k < std::min(sources.seen.size(), listedSources); ++k) {
        const GlareSource& source = sources.seen[k];
        rows.push_back({source.name, fmt::format("{:.4g} cd/m²", source.luminance),
                        fmt::format("{:.3g} sr", source.solidAngle), fmt::format("{:.3g}", source.positionIndex),
                        fmt::format("{:.0f} %", 100 * source.visible),
                        fmt::format("{:.1f} %", 100 * source.strength() / all)});
    }
    std::string table = htmlTable(rows);
    if (sources.seen.size() <= listedSources) return table;
    return table + paragraph(fmt::format("and {} weaker ones.", sources.seen.size() - listedSources));
}

std::string observer(const ObserverPart& part, bool hasSky) {
    const ObserverFigures& figures = part.figures;
    const glm::dvec3 &p = figures.observer.position, &d = figures.observer.direction;
    const std::string text = fmt::format(
        "Eye at {:.7g}, {:.7g}, {:.7g}, looking along {:.3g}, {:.3g}, {:.3g}. Indirect vertical illuminance {} lx "
        "({}), direct {} lx; {} passes, {:.1f} s.{}",
        p.x, p.y, p.z, d.x, d.y, d.z, valueText(figures.indirect), intervalText(figures.indirect),
        valueText(figures.direct), part.passes, part.seconds, hasSky ? " By the lamps alone, without the sky." : "");
    std::string remarks;
    for (const std::string& remark : glareRemarks(figures)) remarks += paragraph(remark, "warning");
    return fmt::format("<section><h3>{}</h3>\n", htmlEscaped(figures.observer.name)) + paragraph(text) +
           sourceTable(figures.sources) + remarks + "</section>\n";
}

std::string luminaire(const LuminaireRow& row) {
    const Photometry figures = photometryOf(row.goniogram);
    std::vector<TableRow> rows{{"file", row.goniogram.path.substr(row.goniogram.path.find_last_of('/') + 1)},
                               {"in the scene", fmt::format("{}", row.count)},
                               {"luminous flux by the file", fmt::format("{:.5g} lm", figures.lumens)},
                               {"of all in the scene", fmt::format("{:.5g} lm", row.lumens)},
                               {"upwards", fmt::format("{:.1f} %", 100 * figures.upwardLumens / figures.lumens)},
                               {"luminous shape", row.goniogram.shape.text()}};
    if (row.watts > 0) {
        rows.push_back({"power of all", fmt::format("{:.5g} W", row.watts)});
        rows.push_back({"efficacy by the file", fmt::format("{:.4g} lm/W", figures.efficacy())});
    }
    for (const PlaneAngles& plane : figures.planes)
        rows.push_back({fmt::format("beam, field angle C{:g}–C{:g}", plane.c, plane.c + 180),
                        fmt::format("{:.1f}°, {:.1f}°", plane.beam, plane.field)});
    for (const LuminanceRow& at : figures.luminances)
        if (at.gamma == 65 || at.gamma == 75 || at.gamma == 85)
            rows.push_back(
                {fmt::format("highest luminance at gamma {:g}°", at.gamma), fmt::format("{:.4g} cd/m²", at.highest)});
    return "<div class=\"luminaire\"><div>" + svgOf(polarCurve(row.goniogram)) + "</div><div>" + htmlTable(rows) +
           "</div></div>\n";
}

std::string luminaires(const ReportContent& content) {
    std::string out = "<h2>Luminaires</h2>\n";
    for (const LuminaireRow& row : content.luminaires) out += luminaire(row);
    if (content.luminaires.empty()) out += paragraph("No luminaire comes from a file.");
    if (content.otherLamps > 0) out += paragraph(fmt::format("Other emitters: {}.", content.otherLamps));
    return out;
}

std::string computation(const ReportContent& content) {
    std::vector<TableRow> rows{{"setting", "value"}};
    for (const auto& [name, value] : content.settings) rows.push_back({name, value});
    std::string out = "<h2>How it was computed</h2>\n" + htmlTable(rows);
    for (const std::string& warning : content.warnings) out += paragraph(warning, "warning");
    return out;
}

} // namespace

std::string reportPage(const ReportContent& content) {
    std::string out = htmlHead("Lighting report: " + content.scene, style);
    out += fmt::format("<h1>Lighting report</h1>\n<p class=\"note\">{}, by quasilux {} in {:.1f} s</p>\n",
                       htmlEscaped(content.scene), QUASILUX_VERSION, content.seconds);
    out += "<section><h2>Figures</h2>\n" + summary(content) + "</section>\n";
    for (const GridPart& part : content.grids) out += grid(part, content.grids.size() == 1);
    if (content.picture) out += pictures(*content.picture);
    if (!content.observers.empty()) out += "<h2>Glare: UGR (CIE 117)</h2>\n";
    for (const ObserverPart& part : content.observers) out += observer(part, content.hasSky);
    return out + luminaires(content) + computation(content) + "</body></html>\n";
}

} // namespace quasilux
