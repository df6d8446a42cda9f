// Polar curves: gamma from straight down, intensity outwards.
#include "drawing/drawing.h"
#include "drawing/value_scale.h"
#include "photometry/photometry.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr double width = 480, height = 540, radius = 190;
constexpr Place centre{240, 262};
// The two differ in dashes as well as in colour.
constexpr Colour along{0x00, 0x72, 0xb2}, across{0xd5, 0x5e, 0x00};

/// `share` of the radius along gamma, to the right where it is positive.
Place placeAt(double gamma, double share) {
    const double angle = gamma * std::numbers::pi / 180;
    return {centre.x + radius * share * std::sin(angle), centre.y + radius * share * std::cos(angle)};
}

void addGrid(Drawing& drawing, double ring, int rings) {
    for (int k = 1; k <= rings; ++k) {
        const double share = static_cast<double>(k) / rings;
        drawing.add(DrawnCircle{centre, radius * share, paleGrey});
        drawing.add(DrawnText{.place = placeAt(15, share), .text = markText(k * ring), .colour = midGrey});
    }
    for (int gamma = -150; gamma <= 180; gamma += 30) {
        const Place label = placeAt(gamma, 1.09);
        drawing.add(DrawnLine{{centre, placeAt(gamma, 1)}, paleGrey});
        drawing.add(DrawnText{.place = {label.x, label.y + 4},
                              .text = fmt::format("{}°", std::abs(gamma)),
                              .anchor = TextAnchor::middle});
    }
}

void addCurve(Drawing& drawing, const Goniogram& goniogram, double c, double scale) {
    DrawnLine line{{}, c == 0 ? along : across, 2, c != 0};
    for (int k = -360; k <= 360; ++k)
        line.places.push_back(placeAt(0.5 * k, intensityInPlane(goniogram, c, 0.5 * k) / scale));
    drawing.add(line);
}

void addLegend(Drawing& drawing, double y, double c, const char* text) {
    drawing.add(DrawnLine{{{24, y}, {60, y}}, c == 0 ? along : across, 2, c != 0});
    drawing.add(DrawnText{.place = {68, y + 4}, .text = text});
}

} // namespace

Drawing polarCurve(const Goniogram& goniogram) {
    double largest = 0;
    for (int k = -360; k <= 360; ++k)
        for (const double c : {0.0, 90.0}) largest = std::max(largest, intensityInPlane(goniogram, c, 0.5 * k));
    if (!(largest > 0)) largest = goniogram.largest();
    const double ring = niceStep(largest);
    const int rings = static_cast<int>(std::ceil(largest / ring * (1 - 1e-9)));
    Drawing drawing{width,
                    height,
                    goniogram.luminaire.empty() ? std::filesystem::path(goniogram.path).filename().string()
                                                : goniogram.luminaire,
                    {}};
    drawing.add(DrawnText{.place = {24, 24}, .text = drawing.title, .bold = true});
    addGrid(drawing, ring, rings);
    addCurve(drawing, goniogram, 0, ring * rings);
    addCurve(drawing, goniogram, 90, ring * rings);
    addLegend(drawing, 498, 0, "C180 (left) – C0 (right)");
    addLegend(drawing, 518, 90, "C270 (left) – C90 (right)");
    drawing.add(DrawnText{.place = {width - 24, 518},
                          .text = fmt::format("cd, {:.6g} lm", goniogram.lumens()),
                          .anchor = TextAnchor::end});
    return drawing;
}

} // namespace quasilux
