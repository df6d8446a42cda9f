#include "bench/svg_plot.h"

#include "compare/html_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

// Distinguishable also for those who do not see all colours (Okabe & Ito 2008).
constexpr std::array<const char*, 8> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000", "#999933"};
constexpr double width = 640, height = 420, left = 70, right = 190, top = 34, bottom = 50;

/// From a value to a place along an axis.
struct LogAxis {
    int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min(); ///< decades

    void add(double value) {
        lowest = std::min(lowest, static_cast<int>(std::floor(std::log10(value))));
        highest = std::max(highest, static_cast<int>(std::ceil(std::log10(value))));
    }
    /// One decade at least.
    void widen() { highest = std::max(highest, lowest + 1); }
    bool isEmpty() const { return lowest > highest; }
    double at(double value, double from, double to) const {
        return from + (to - from) * (std::log10(value) - lowest) / (highest - lowest);
    }
};

bool isDrawn(const std::pair<double, double>& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && point.first > 0 && point.second > 0;
}

struct Frame {
    LogAxis x, y;
    double atX(double value) const { return x.at(value, left, width - right); }
    double atY(double value) const { return y.at(value, height - bottom, top); }
};

std::string grid(const Frame& frame) {
    std::string out;
    for (int k = frame.x.lowest; k <= frame.x.highest; ++k) {
        const double place = frame.atX(std::pow(10.0, k));
        out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" class=\"grid\"/>"
                           "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
                           place, top, height - bottom, height - bottom + 18, std::pow(10.0, k));
    }
    for (int k = frame.y.lowest; k <= frame.y.highest; ++k) {
        const double place = frame.atY(std::pow(10.0, k));
        out += fmt::format("<line x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" class=\"grid\"/>"
                           "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">1e{5}</text>\n",
                           place, left, width - right, left - 8, place + 4, k);
    }
    return out;
}

std::string line(const Frame& frame, const PlotSeries& series, size_t index) {
    const char* colour = colours[index % colours.size()];
    std::string path, marks;
    for (const auto& point : series.points) {
        if (!isDrawn(point)) continue;
        const double x = frame.atX(point.first), y = frame.atY(point.second);
        path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "M" : "L", x, y);
        marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", x, y, colour);
    }
    const double legend = top + 10 + 18 * static_cast<double>(index);
    // From the ninth series on colours come again: dashes distinguish them.
    const char* dash = index >= colours.size() ? " stroke-dasharray=\"5 3\"" : "";
    return fmt::format("<path d=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"1.8\"{2}/>{3}\n"
                       "<line x1=\"{4}\" x2=\"{5}\" y1=\"{6}\" y2=\"{6}\" stroke=\"{1}\" stroke-width=\"1.8\"{2}/>"
                       "<text x=\"{7}\" y=\"{8}\">{9}</text>\n",
                       path, colour, dash, marks, width - right + 12, width - right + 32, legend, width - right + 38,
                       legend + 4, htmlEscaped(series.name));
}

} // namespace

std::string logLogPlot(const PlotText& text, const std::vector<PlotSeries>& series) {
    Frame frame;
    for (const PlotSeries& one : series)
        for (const auto& point : one.points) {
            if (!isDrawn(point)) continue;
            frame.x.add(point.first);
            frame.y.add(point.second);
        }
    if (frame.x.isEmpty()) return fmt::format("<p>{}: nothing to draw.</p>\n", htmlEscaped(text.title));
    frame.x.widen();
    frame.y.widen();
    std::string out = fmt::format("<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" role=\"img\" aria-label=\"{2}\">\n"
                                  "<text x=\"{3}\" y=\"18\" class=\"title\">{2}</text>\n",
                                  width, height, htmlEscaped(text.title), left);
    out += grid(frame);
    for (size_t k = 0; k < series.size(); ++k) out += line(frame, series[k], k);
    const double middleX = (left + width - right) / 2, middleY = (top + height - bottom) / 2;
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", middleX, height - 10,
                       htmlEscaped(text.x));
    out += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", middleY,
                       htmlEscaped(text.y));
    return out + "</svg>\n";
}

} // namespace quasilux
