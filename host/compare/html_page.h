// One page with both images, the error and the figures, which needs nothing besides itself.
#pragma once

#include "compare/html_parts.h"
#include "compare/measures.h"

namespace quasilux {

struct PageText {
    std::string title;
    std::vector<TableRow> regions, worst; ///< the first row of each is its headings
    std::vector<std::string> remarks;     ///< lines below the title, such as what was exceeded
};

/// HTML with PNGs inside and a script of its own: exposure, and the other image while the pointer is on one.
std::string htmlPage(const RadianceImage& image, const RadianceImage& reference, const Comparison& comparison,
                     const PageText& text);

} // namespace quasilux
