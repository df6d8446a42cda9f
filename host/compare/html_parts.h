// Parts of pages.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

/// A row of a page's table, as many cells as there are headings.
using TableRow = std::vector<std::string>;

/// Text as it may stand in an element or an attribute.
std::string htmlEscaped(const std::string& text);

/// The first row is the headings.
std::string htmlTable(const std::vector<TableRow>& rows);

} // namespace quasilux
