#include "photometry/false_colour.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double margin = 16, barWidth = 18, lineHeight = 13;
constexpr unsigned smallest = 480; // pixels that a picture is wide at least

std::vector<double> finiteOf(const std::vector<float>& values) {
    std::vector<double> finite;
    for (const float value : values)
        if (std::isfinite(value)) finite.push_back(value);
    return finite;
}

std::string figuresOf(const LuminanceImage& image) {
    const std::vector<double> values = finiteOf(image.values);
    if (values.empty()) return "no pixel is finite";
    double sum = 0;
    for (const double value : values) sum += value;
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    const auto left = image.values.size() - values.size();
    return fmt::format("minimum {:.4g}, mean {:.4g}, maximum {:.4g} {}{}", *least,
                       sum / static_cast<double>(values.size()), *largest, image.unit(),
                       left > 0 ? fmt::format("; {} pixels are not finite (magenta)", left) : "");
}

} // namespace

ValueScale scaleOfImage(const LuminanceImage& image, bool logarithmic) {
    return automaticScale(finiteOf(image.values), logarithmic, 0.02);
}

std::vector<uint8_t> falseColours(const std::vector<float>& values, const FalseColours& colours) {
    std::vector<uint8_t> pixels;
    pixels.reserve(3 * values.size());
    for (const float value : values) {
        const Colour colour = std::isfinite(value) ? colourOf(colours.map, colours.scale.shareOf(value)) : notFinite;
        pixels.insert(pixels.end(), {colour.r, colour.g, colour.b});
    }
    return pixels;
}

void addLegend(Drawing& drawing, Place corner, double height, const FalseColours& colours, const std::string& unit,
               const Beyond& beyond) {
    const double top = corner.y + 24, length = height - 28;
    DrawnPicture bar{{corner.x, top}, barWidth, length, 1, 256, {}};
    for (int k = 255; k >= 0; --k) {
        const Colour colour = colourOf(colours.map, k / 255.0);
        bar.pixels.insert(bar.pixels.end(), {colour.r, colour.g, colour.b});
    }
    drawing.add(bar);
    drawing.add(DrawnText{.place = {corner.x, corner.y + 12}, .text = unit, .bold = true});
    const auto addMark = [&](double value, const std::string& text) {
        const double y = top + length * (1 - colours.scale.shareOf(value));
        drawing.add(DrawnLine{{{corner.x + barWidth, y}, {corner.x + barWidth + 5, y}}});
        drawing.add(DrawnText{.place = {corner.x + barWidth + 9, y + 4}, .text = text});
    };
    const ValueScale& scale = colours.scale;
    if (beyond.above) addMark(scale.to, "≥ " + markText(scale.to));
    if (beyond.below) addMark(scale.from, "≤ " + markText(scale.from));
    for (const double mark : scale.marks()) { // none on those of the ends
        const bool isTaken = (beyond.above && length * (1 - scale.shareOf(mark)) < lineHeight) ||
                             (beyond.below && length * scale.shareOf(mark) < lineHeight);
        if (!isTaken) addMark(mark, markText(mark));
    }
}

Drawing falseColourDrawing(const LuminanceImage& image, const FalseColours& colours, const std::string& title) {
    const unsigned factor = std::max(1u, (smallest + image.width - 1) / image.width);
    const double width = double(factor) * image.width, height = double(factor) * image.height,
                 tall = std::max(height, 200.0);
    Drawing drawing{width + 3 * margin + legendWidth, tall + 3 * margin + 24, title, {}};
    drawing.add(
        DrawnPicture{{margin, margin}, width, height, image.width, image.height, falseColours(image.values, colours)});
    addLegend(drawing, {2 * margin + width, margin}, tall, colours, image.unit(),
              beyondScale(image.values, colours.scale));
    drawing.add(DrawnText{.place = {margin, tall + 2 * margin + 8}, .text = figuresOf(image)});
    drawing.add(DrawnText{.place = {margin, tall + 2 * margin + 24},
                          .text = (image.isIlluminance ? "illuminance: " : "luminance: ") + image.conversion,
                          .colour = midGrey,
                          .size = 11});
    return drawing;
}

} // namespace quasilux
