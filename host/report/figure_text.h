// Figures in words and in JSON.
#pragma once

#include "compare/html_parts.h"
#include "report/report_content.h"

#include <nlohmann/json.hpp>

namespace quasilux {

/// The value with as many digits as its error leaves.
std::string valueText(const Figure& figure);
/// "± 1.2", at 95 %, or "not known".
std::string intervalText(const Figure& figure);

/// Name, value, interval, relative interval, standard error, bias; the first row is the headings.
std::vector<TableRow> figureRows(const ReportContent& content);

/// What limits the rating, a sentence or two each.
std::vector<std::string> glareRemarks(const ObserverFigures& figures);

nlohmann::json reportJson(const ReportContent& content);

} // namespace quasilux
