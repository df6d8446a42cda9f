// Column widths and units of bytes.
#include "cli/text_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

std::string TextTable::text(const std::string& indent) const {
    std::vector<size_t> widths(rows_.front().size());
    for (const auto& row : rows_)
        for (size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string out;
    for (const auto& row : rows_) {
        std::string line = indent;
        for (size_t i = 0; i < widths.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
    return out;
}

std::string tableText(const std::vector<std::vector<std::string>>& rows) {
    TextTable table(rows.front());
    for (size_t i = 1; i < rows.size(); ++i) table.add(rows[i]);
    return table.text();
}

std::string bytesText(uint64_t bytes) {
    const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    size_t unit = 0;
    while (value >= 1024 && unit + 1 < std::size(units)) {
        value /= 1024;
        ++unit;
    }
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, units[unit]);
}

} // namespace quasilux
