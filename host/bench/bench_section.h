// What a part of a benchmark says: figures for JSON, and the same for people, on the page and in the terminal.
#pragma once

#include "compare/html_parts.h"

#include <nlohmann/json.hpp>

namespace quasilux {

struct BenchTable {
    std::string title;
    std::string plot;           ///< SVG, or empty
    std::vector<TableRow> rows; ///< headings first
    std::string note;           ///< how to read it, or empty
};

struct BenchSection {
    std::string key;   ///< in the JSON
    std::string title; ///< on the page
    nlohmann::json figures;
    std::vector<BenchTable> tables;
};

} // namespace quasilux
