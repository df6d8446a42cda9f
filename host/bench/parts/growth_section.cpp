// Growth in tables, JSON and plots.
#include "bench/parts/growth.h"
#include "bench/power_law.h"
#include "bench/svg_plot.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr double plottedShare = 0.02; // of a pass: kernels that never take more are left out of plots

using Points = std::vector<std::pair<double, double>>;

/// "pass", kernels, "preparing", "buffers, bytes": costs by size.
std::vector<std::pair<std::string, Points>> costsOf(const GrowthSeries& series) {
    std::set<std::string> kernels;
    for (const auto& point : series.points)
        for (const auto& [kernel, seconds] : point.measured.least.kernelCosts)
            if (seconds > plottedShare * point.measured.least.cost(series.isCpu)) kernels.insert(kernel);
    std::vector<std::pair<std::string, Points>> costs{{"pass", {}}};
    for (const std::string& kernel : kernels) costs.push_back({kernel, {}});
    for (auto& [name, points] : costs)
        for (const auto& point : series.points) {
            const PassTimes& least = point.measured.least;
            if (name == "pass") points.emplace_back(point.size, least.cost(series.isCpu));
            if (const auto found = least.kernelCosts.find(name); found != least.kernelCosts.end())
                points.emplace_back(point.size, found->second);
        }
    Points preparing, bytes;
    for (const auto& point : series.points) {
        preparing.emplace_back(point.size, point.measured.prepare);
        bytes.emplace_back(point.size, double(point.measured.bufferBytes));
    }
    if (series.subject == "triangles") costs.push_back({"preparing", preparing});
    costs.push_back({"buffers, bytes", bytes});
    return costs;
}

json seriesJson(const GrowthSeries& series) {
    json points = json::array(), exponents = json::object();
    for (const auto& point : series.points) {
        json entry = passMeasurementJson(point.measured);
        entry["size"] = point.size;
        points.push_back(entry);
    }
    for (const auto& [name, costs] : costsOf(series))
        if (const auto law = fitPowerLaw(costs))
            exponents[name] = {{"exponent", law->exponent}, {"standardError", law->standardError}};
    return {{"subject", series.subject},
            {"device", series.device},
            {"points", points},
            {"exponents", exponents},
            {"stopped", series.stopped.empty() ? json() : json(series.stopped)}};
}

std::string axisTitle(const std::string& subject) {
    if (subject == "bdd") return "1 + BDD";
    return subject == "photons" ? "photons a pass" : subject;
}

std::string plotOf(const GrowthSeries& series) {
    std::vector<PlotSeries> lines;
    for (const auto& [name, costs] : costsOf(series))
        if (name != "buffers, bytes") lines.push_back({name, costs});
    return logLogPlot({"cost of a pass by " + axisTitle(series.subject), axisTitle(series.subject), "seconds"}, lines);
}

std::string costText(const std::string& name, double cost) {
    return name == "buffers, bytes" ? fmt::format("{:.1f} MB", 1e-6 * cost) : fmt::format("{:.2f} ms", 1e3 * cost);
}

/// A column for each cost, a row for each size, the exponents last.
std::vector<TableRow> rowsOf(const GrowthSeries& series) {
    const auto costs = costsOf(series);
    std::vector<TableRow> rows{{axisTitle(series.subject)}};
    for (const auto& point : series.points) rows.push_back({fmt::format("{:.0f}", point.size)});
    rows.push_back({"exponent"});
    for (const auto& [name, points] : costs) {
        rows.front().push_back(name);
        for (size_t k = 0; k < series.points.size(); ++k) {
            const double size = series.points[k].size;
            const auto found =
                std::find_if(points.begin(), points.end(), [&](const auto& point) { return point.first == size; });
            rows[k + 1].push_back(found == points.end() ? "" : costText(name, found->second));
        }
        const auto law = fitPowerLaw(points);
        rows.back().push_back(law ? fmt::format("{:.2f} +- {:.2f}", law->exponent, law->standardError) : "");
    }
    return rows;
}

} // namespace

BenchSection growthSection(const std::vector<GrowthSeries>& all) {
    BenchSection section{"growth", "Growth", json::array(), {}};
    for (const GrowthSeries& series : all) {
        section.figures.push_back(seriesJson(series));
        std::string note =
            fmt::format("{}; of kernels by their shares of it, by their own counters. The least of several passes.",
                        series.isCpu ? "CPU time" : "Time on the clock");
        if (!series.stopped.empty()) note += " Stopped at " + series.stopped;
        section.tables.push_back({fmt::format("{}, device {}", axisTitle(series.subject), series.device),
                                  plotOf(series), rowsOf(series), note});
    }
    return section;
}

} // namespace quasilux
