// What micro-benchmarks find: rates of several ways to do the same work, and their ratios.
#pragma once

#include "compare/html_parts.h"
#include "device/device.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

/// One case of one part: every way to do it, by name.
struct MicroRow {
    std::string part, name;
    unsigned threads = 1;
    std::string unit; ///< of `values`
    std::vector<std::pair<std::string, double>> values, ratios;
    size_t compared = 0, differing = 0; ///< results held against the other side's; 0, 0: there is no other
};

struct MicroReport {
    DeviceInfo device;
    std::vector<MicroRow> rows;
};

/// Parts that have rows, in order.
std::vector<std::string> partsOf(const MicroReport& report);

/// A part as a table, headings first.
std::vector<TableRow> microTable(const MicroReport& report, const std::string& part);

/// Keys: docs/reference/benchmarks.md.
nlohmann::json microJson(const MicroReport& report);

/// A section of a page.
std::string microSection(const MicroReport& report);

} // namespace quasilux
