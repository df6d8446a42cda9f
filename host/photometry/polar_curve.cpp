// Polar curves: gamma from straight down, intensity outwards.
#include "compare/html_parts.h"
#include "photometry/photometry.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr double width = 480, height = 540, centreX = 240, centreY = 262, radius = 190;

/// 1, 2 or 5 times a power of ten, so that four to ten of it reach `largest`.
double niceStep(double largest) {
    const double power = std::pow(10.0, std::floor(std::log10(largest / 4)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= largest / 4) return factor * power;
    return power;
}

struct Place {
    double x, y;
};
/// `share` of the radius along gamma, to the right where it is positive.
Place placeAt(double gamma, double share) {
    const double angle = gamma * std::numbers::pi / 180;
    return {centreX + radius * share * std::sin(angle), centreY + radius * share * std::cos(angle)};
}

std::string grid(double ring, int rings) {
    std::string out;
    for (int k = 1; k <= rings; ++k) {
        const double share = static_cast<double>(k) / rings;
        out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.1f}\" class=\"grid\"/>\n", centreX, centreY,
                           radius * share);
        const Place label = placeAt(15, share);
        out +=
            fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"ring\">{:.6g}</text>\n", label.x, label.y, k * ring);
    }
    for (int gamma = -150; gamma <= 180; gamma += 30) {
        const Place end = placeAt(gamma, 1), label = placeAt(gamma, 1.09);
        out += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"grid\"/>"
                           "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}°</text>\n",
                           centreX, centreY, end.x, end.y, label.x, label.y + 4, std::abs(gamma));
    }
    return out;
}

std::string curve(const Goniogram& goniogram, double c, double scale, const char* style) {
    std::string path;
    for (int k = -360; k <= 360; ++k) {
        const Place place = placeAt(0.5 * k, intensityInPlane(goniogram, c, 0.5 * k) / scale);
        path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "M" : "L", place.x, place.y);
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", path, style);
}

std::string legend(double y, const char* style, const char* text) {
    return fmt::format("<line x1=\"24\" x2=\"60\" y1=\"{0}\" y2=\"{0}\" {1}/><text x=\"68\" y=\"{2}\">{3}</text>\n", y,
                       style, y + 4, text);
}

} // namespace

std::string polarCurveSvg(const Goniogram& goniogram) {
    // The two differ in dashes as well as in colour.
    constexpr const char* along = "stroke=\"#0072b2\" stroke-width=\"2\"";
    constexpr const char* across = "stroke=\"#d55e00\" stroke-width=\"2\" stroke-dasharray=\"7 4\"";
    double largest = 0;
    for (int k = -360; k <= 360; ++k)
        for (const double c : {0.0, 90.0}) largest = std::max(largest, intensityInPlane(goniogram, c, 0.5 * k));
    if (!(largest > 0)) largest = goniogram.largest();
    const double ring = niceStep(largest);
    const int rings = static_cast<int>(std::ceil(largest / ring * (1 - 1e-9)));
    const std::string title =
        goniogram.luminaire.empty() ? std::filesystem::path(goniogram.path).filename().string() : goniogram.luminaire;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">\n"
        "<title>{2}</title>\n<style>text{{font:12px sans-serif;fill:#222}}.ring{{fill:#666}}"
        ".grid{{fill:none;stroke:#ccc}}.title{{font-weight:bold}}</style>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n<text x=\"24\" y=\"24\" class=\"title\">{2}</text>\n",
        width, height, htmlEscaped(title));
    out += grid(ring, rings);
    out += curve(goniogram, 0, ring * rings, along) + curve(goniogram, 90, ring * rings, across);
    out += legend(498, along, "C180 (left) – C0 (right)") + legend(518, across, "C270 (left) – C90 (right)");
    out += fmt::format("<text x=\"{}\" y=\"518\" text-anchor=\"end\">cd, {:.6g} lm</text>\n", width - 24,
                       goniogram.lumens());
    return out + "</svg>\n";
}

} // namespace quasilux
