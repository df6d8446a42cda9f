// Parts of pages.
#pragma once

#include "compare/error_picture.h"

#include <string>
#include <vector>

namespace quasilux {

/// A row of a page's table, as many cells as there are headings.
using TableRow = std::vector<std::string>;

/// Text as it may stand in an element or an attribute.
std::string htmlEscaped(const std::string& text);

/// From the doctype to the opening <body>, with the style that all pages share and `style` after it.
std::string htmlHead(const std::string& title, const std::string& style);

std::string htmlFigure(const Picture& picture, unsigned width, unsigned height, const std::string& caption);

/// The first row is the headings.
std::string htmlTable(const std::vector<TableRow>& rows);

} // namespace quasilux
