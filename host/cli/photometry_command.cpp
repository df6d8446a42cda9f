#include "cli/commands.h"

#include "cli/text_table.h"
#include "output/atomic_file.h"
#include "photometry/photometry.h"
#include "util/messages.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quasilux {

namespace {

nlohmann::json orNull(double value) { return value > 0 ? nlohmann::json(value) : nlohmann::json(nullptr); }

nlohmann::json photometryJson(const Goniogram& goniogram, const Photometry& figures) {
    nlohmann::json planes = nlohmann::json::array(), luminances = nlohmann::json::array();
    for (const PlaneAngles& plane : figures.planes)
        planes.push_back({{"c", plane.c}, {"beamAngle", plane.beam}, {"fieldAngle", plane.field}});
    for (const LuminanceRow& row : figures.luminances)
        luminances.push_back({{"gamma", row.gamma}, {"c0", row.c0}, {"c90", row.c90}, {"highest", row.highest}});
    const LampSet& lamps = goniogram.lampSets[goniogram.lampSet];
    return {{"version", QUASILUX_VERSION},
            {"file", goniogram.path},
            {"format", goniogram.format},
            {"luminaire", goniogram.luminaire},
            {"absolute", goniogram.absolute},
            {"lamps", lamps.lamps},
            {"lampLumens", orNull(figures.lampLumens)},
            {"statedLightOutputRatio", orNull(goniogram.statedRatio / 100)},
            {"luminousShape", goniogram.shape.text()},
            {"lumens", figures.lumens},
            {"upwardLumens", figures.upwardLumens},
            {"watts", orNull(figures.watts)},
            {"efficacy", orNull(figures.efficacy())},
            {"maximum", {{"candela", figures.largest}, {"c", figures.largestC}, {"gamma", figures.largestGamma}}},
            {"planes", planes},
            {"luminances", luminances}};
}

void printHead(const Goniogram& goniogram, const Photometry& figures) {
    const LampSet& lamps = goniogram.lampSets[goniogram.lampSet];
    fmt::print("file: {} ({}, {} photometry)\n", goniogram.path, goniogram.format,
               goniogram.absolute ? "absolute" : "relative");
    if (!goniogram.luminaire.empty()) fmt::print("luminaire: {}\n", goniogram.luminaire);
    fmt::print("luminous shape: {}\n", goniogram.shape.text());
    if (figures.lampLumens > 0)
        fmt::print("lamps: {}, {:.6g} lm together; of these leave the luminaire {:.1f} %{}\n", lamps.lamps,
                   figures.lampLumens, 100 * figures.lumens / figures.lampLumens,
                   goniogram.statedRatio > 0 ? fmt::format(", by the file {:.4g} %", goniogram.statedRatio) : "");
    fmt::print("luminous flux: {:.6g} lm, upwards {:.1f} %\n", figures.lumens,
               100 * figures.upwardLumens / figures.lumens);
    if (figures.watts > 0) fmt::print("power: {:.6g} W, efficacy {:.4g} lm/W\n", figures.watts, figures.efficacy());
    fmt::print("largest intensity: {:.6g} cd at C {:.4g}°, gamma {:.4g}°\n", figures.largest, figures.largestC,
               figures.largestGamma);
}

void printTables(const Photometry& figures) {
    TextTable angles({"plane", "beam angle (50 %)", "field angle (10 %)"});
    for (const PlaneAngles& plane : figures.planes)
        angles.add({fmt::format("C{:g}-C{:g}", plane.c, plane.c + 180), fmt::format("{:.1f}°", plane.beam),
                    fmt::format("{:.1f}°", plane.field)});
    fmt::print("\n{}", angles.text());
    if (figures.luminances.empty()) {
        fmt::print("\nluminances: none, the luminous shape is a point\n");
        return;
    }
    TextTable luminances({"gamma", "C0 (cd/m²)", "C90 (cd/m²)", "highest of all C (cd/m²)"});
    for (const LuminanceRow& row : figures.luminances)
        luminances.add({fmt::format("{:g}°", row.gamma), fmt::format("{:.5g}", row.c0), fmt::format("{:.5g}", row.c90),
                        fmt::format("{:.5g}", row.highest)});
    fmt::print("\n{}", luminances.text());
}

} // namespace

int photometryCommand(const PhotometryOptions& options) {
    if (!options.svg.empty()) checkOutputPath(options.svg, "--svg", ".svg");
    const Goniogram goniogram = readGoniogram(options.file, {}, options.lampSet);
    for (const std::string& warning : goniogram.warnings)
        if (!options.quiet) printWarning(warning);
    const Photometry figures = photometryOf(goniogram);
    if (!options.svg.empty()) writeText(options.svg, svgOf(polarCurve(goniogram)));
    if (options.json) {
        fmt::print("{}\n",
                   photometryJson(goniogram, figures).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else if (!options.quiet) {
        printHead(goniogram, figures);
        printTables(figures);
        if (!options.svg.empty()) fmt::print("\nwrote {}\n", options.svg);
    }
    return 0;
}

} // namespace quasilux
