#include "compare/html_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr const char* sharedStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 24px; color: #222; background: #fafafa; }
figure { display: inline-block; margin: 0 16px 16px 0; vertical-align: top; width: min-content; }
img { image-rendering: pixelated; display: block; }
table { border-collapse: collapse; margin: 12px 0; }
td, th { padding: 3px 12px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td:first-child, th:first-child { text-align: left; }
)";

} // namespace

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

std::string htmlHead(const std::string& title, const std::string& style) {
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>{}{}"
                       "</style></head><body>\n",
                       htmlEscaped(title), sharedStyle, style);
}

std::string htmlFigure(const Picture& picture, unsigned width, unsigned height, const std::string& caption) {
    return fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                       htmlEscaped(caption), pngDataUri(picture, width, height));
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
