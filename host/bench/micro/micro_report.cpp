#include "bench/micro/micro_report.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

using nlohmann::json;

namespace {

using Figures = std::vector<std::pair<std::string, double>>;

void addNames(std::vector<std::string>& names, const Figures& figures) {
    for (const auto& [name, value] : figures)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void addCells(TableRow& row, const std::vector<std::string>& names, const Figures& figures, const char* format) {
    for (const std::string& name : names) {
        const auto found =
            std::find_if(figures.begin(), figures.end(), [&](const auto& figure) { return figure.first == name; });
        row.push_back(found == figures.end() ? "" : fmt::format(fmt::runtime(format), found->second));
    }
}

json figuresJson(const Figures& figures) {
    json object = json::object();
    for (const auto& [name, value] : figures) object[name] = value;
    return object;
}

} // namespace

std::vector<std::string> partsOf(const MicroReport& report) {
    std::vector<std::string> parts;
    for (const MicroRow& row : report.rows)
        if (std::find(parts.begin(), parts.end(), row.part) == parts.end()) parts.push_back(row.part);
    return parts;
}

std::vector<TableRow> microTable(const MicroReport& report, const std::string& part) {
    std::vector<std::string> values, ratios;
    std::string unit;
    bool compares = false;
    for (const MicroRow& row : report.rows) {
        if (row.part != part) continue;
        addNames(values, row.values);
        addNames(ratios, row.ratios);
        unit = row.unit;
        compares = compares || row.compared > 0;
    }
    std::vector<TableRow> rows{{part + ", " + unit, "threads"}};
    rows[0].insert(rows[0].end(), values.begin(), values.end());
    rows[0].insert(rows[0].end(), ratios.begin(), ratios.end());
    if (compares) rows[0].push_back("differing");
    for (const MicroRow& row : report.rows) {
        if (row.part != part) continue;
        TableRow cells{row.name, std::to_string(row.threads)};
        addCells(cells, values, row.values, "{:.3g}");
        addCells(cells, ratios, row.ratios, "{:.2f}");
        if (compares) cells.push_back(fmt::format("{} of {}", row.differing, row.compared));
        rows.push_back(cells);
    }
    return rows;
}

json microJson(const MicroReport& report) {
    json rows = json::array();
    for (const MicroRow& row : report.rows)
        rows.push_back({{"part", row.part},
                        {"case", row.name},
                        {"threads", row.threads},
                        {"unit", row.unit},
                        {"values", figuresJson(row.values)},
                        {"ratios", figuresJson(row.ratios)},
                        {"compared", row.compared},
                        {"differing", row.differing}});
    return {{"device", report.device.name}, {"rows", rows}};
}

std::string microSection(const MicroReport& report) {
    std::string out = fmt::format("<h2>Micro-benchmarks</h2>\n<p>{}</p>\n", htmlEscaped(report.device.name));
    for (const std::string& part : partsOf(report)) out += htmlTable(microTable(report, part));
    return out;
}

} // namespace quasilux
