#include "compare/html_parts.h"

#include <fmt/format.h>

namespace quasilux {

std::string htmlEscaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string htmlTable(const std::vector<TableRow>& rows) {
    std::string out = "<table>\n";
    for (size_t i = 0; i < rows.size(); ++i) {
        const char* tag = i == 0 ? "th" : "td";
        out += "<tr>";
        for (const auto& cell : rows[i]) out += fmt::format("<{0}>{1}</{0}>", tag, htmlEscaped(cell));
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

} // namespace quasilux
