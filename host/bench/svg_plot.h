// Plots as SVG text, for pages that need nothing besides themselves.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

struct PlotSeries {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< x, y; those that are not finite and positive are left out
};

struct PlotText {
    std::string title, x, y;
};

/// Both axes logarithmic, a line at each decade; colours and marks by series, with a legend. Says so where there is
/// nothing to draw.
std::string logLogPlot(const PlotText& text, const std::vector<PlotSeries>& series);

} // namespace quasilux
