// Drawings as SVG.
#include "drawing/drawing.h"

#include "compare/html_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

std::string hex(Colour colour) { return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b); }

std::string element(const DrawnLine& line) {
    std::string path;
    for (const Place& place : line.places)
        path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "M" : "L", place.x, place.y);
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>\n", path, hex(line.colour),
                       line.width, line.dashed ? " stroke-dasharray=\"7 4\"" : "");
}

std::string element(const DrawnCircle& circle) {
    return fmt::format(
        "<circle cx=\"{:g}\" cy=\"{:g}\" r=\"{:.1f}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n",
        circle.centre.x, circle.centre.y, circle.radius, hex(circle.colour), circle.width);
}

std::string element(const DrawnBox& box) {
    return fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"{}\"/>\n", box.corner.x,
                       box.corner.y, box.width, box.height, hex(box.colour));
}

std::string element(const DrawnText& text) {
    const char* anchor = text.anchor == TextAnchor::start    ? ""
                         : text.anchor == TextAnchor::middle ? " text-anchor=\"middle\""
                                                             : " text-anchor=\"end\"";
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" fill=\"{}\"{}{}{}>{}</text>\n", text.place.x,
                       text.place.y, text.size, hex(text.colour), anchor, text.bold ? " font-weight=\"bold\"" : "",
                       text.haloed ? " stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"" : "",
                       htmlEscaped(text.text));
}

std::string element(const DrawnPicture& picture) {
    return fmt::format("<image x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" preserveAspectRatio=\"none\" "
                       "style=\"image-rendering:pixelated\" href=\"{}\"/>\n",
                       picture.corner.x, picture.corner.y, picture.width, picture.height,
                       pngDataUri(picture.pixels, picture.columns, picture.rows));
}

} // namespace

std::string svgOf(const Drawing& drawing) {
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
                    "height=\"{1:g}\" role=\"img\" font-family=\"sans-serif\">\n<title>{2}</title>\n"
                    "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n",
                    drawing.width, drawing.height, htmlEscaped(drawing.title));
    for (const DrawnThing& thing : drawing.things)
        out += std::visit([](const auto& one) { return element(one); }, thing);
    return out + "</svg>\n";
}

} // namespace quasilux
