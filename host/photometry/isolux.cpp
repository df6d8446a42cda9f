#include "photometry/isolux.h"

#include "drawing/contours.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double rim = 16, footer = 44, longerSide = 520, leastHeight = 160;
constexpr unsigned finer = 6;                        // parts of a spacing, so that lines are as bilinear as colours
constexpr double roomOfNumber = 34, roomOfLine = 60; // pixels

/// From grid to drawing: v = 0 lies at the bottom.
struct Frame {
    Place corner;
    double width, height, lengthU, lengthV;

    Place place(double u, double v) const {
        return {corner.x + u / lengthU * width, corner.y + (1 - v / lengthV) * height};
    }
};

Frame frameOf(const GridValues& grid) {
    const double perUnit = longerSide / std::max(grid.lengthU, grid.lengthV);
    return {{rim, rim}, perUnit * grid.lengthU, perUnit * grid.lengthV, grid.lengthU, grid.lengthV};
}

/// Border, centres of cells, border.
std::vector<double> placesAlong(unsigned count, double spacing) {
    std::vector<double> places{0};
    for (unsigned k = 0; k < count; ++k) places.push_back((k + 0.5) * spacing);
    places.push_back(count * spacing);
    return places;
}

Field fieldOf(const GridValues& grid) {
    Field field{placesAlong(grid.nx, grid.spacingU()), placesAlong(grid.ny, grid.spacingV()), {}};
    const auto inside = [](size_t k, unsigned count) { return std::clamp<size_t>(k, 1, count) - 1; };
    for (size_t j = 0; j < field.y.size(); ++j)
        for (size_t i = 0; i < field.x.size(); ++i)
            field.values.push_back(grid.values[inside(j, grid.ny) * grid.nx + inside(i, grid.nx)]);
    return field;
}

std::vector<double> refined(const std::vector<double>& places) {
    std::vector<double> fine{places.front()};
    for (size_t k = 1; k < places.size(); ++k)
        for (unsigned part = 1; part <= finer; ++part)
            fine.push_back(std::lerp(places[k - 1], places[k], double(part) / finer));
    return fine;
}

Field refined(const Field& field) {
    Field fine{refined(field.x), refined(field.y), {}};
    for (const double y : fine.y)
        for (const double x : fine.x) fine.values.push_back(field.value(x, y));
    return fine;
}

DrawnPicture colouredField(const Field& field, const Frame& frame, const FalseColours& colours) {
    DrawnPicture picture{frame.corner,
                         frame.width,
                         frame.height,
                         static_cast<unsigned>(std::ceil(frame.width / 2)),
                         static_cast<unsigned>(std::ceil(frame.height / 2)),
                         {}};
    std::vector<float> values;
    for (unsigned row = 0; row < picture.rows; ++row)
        for (unsigned column = 0; column < picture.columns; ++column)
            values.push_back(static_cast<float>(field.value((column + 0.5) / picture.columns * frame.lengthU,
                                                            (1 - (row + 0.5) / picture.rows) * frame.lengthV)));
    picture.pixels = falseColours(values, colours);
    return picture;
}

/// Three digits, without an exponent.
std::string numberText(double value) {
    return std::abs(value) >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// Where the numbers of the points stand; none where there is no room for them.
std::vector<Place> placesOfNumbers(const GridValues& grid, const Frame& frame) {
    std::vector<Place> places;
    if (frame.width / grid.nx < roomOfNumber || frame.height / grid.ny < roomOfNumber / 2) return places;
    for (unsigned j = 0; j < grid.ny; ++j)
        for (unsigned i = 0; i < grid.nx; ++i)
            places.push_back(frame.place((i + 0.5) * grid.spacingU(), (j + 0.5) * grid.spacingV()));
    return places;
}

void addNumbers(Drawing& drawing, const GridValues& grid, const std::vector<Place>& places) {
    for (size_t k = 0; k < places.size(); ++k)
        drawing.add(DrawnText{.place = {places[k].x, places[k].y + 3},
                              .text = numberText(grid.values[k]),
                              .anchor = TextAnchor::middle,
                              .size = 10,
                              .haloed = true});
}

/// On the line, as far from numbers as it goes, and from the border.
Place labelPlace(const std::vector<Place>& line, const std::vector<Place>& taken, const Frame& frame) {
    Place best = middleOf(line);
    double room = -1;
    for (const Place& place : line) {
        double here = std::min({place.x - frame.corner.x, frame.corner.x + frame.width - place.x,
                                2 * (place.y - frame.corner.y), 2 * (frame.corner.y + frame.height - place.y)});
        // Numbers are twice as wide as high.
        for (const Place& other : taken) here = std::min(here, std::hypot(place.x - other.x, 2 * (place.y - other.y)));
        if (here <= room) continue;
        room = here;
        best = place;
    }
    return best;
}

void addLine(Drawing& drawing, std::vector<Place> line, const Frame& frame, double level, std::vector<Place>& taken) {
    for (Place& place : line) place = frame.place(place.x, place.y);
    const double length = lengthOf(line);
    const Place label = labelPlace(line, taken, frame);
    drawing.add(DrawnLine{line, white, 2.5});
    drawing.add(DrawnLine{std::move(line), black, 1.2});
    if (length < roomOfLine) return;
    drawing.add(DrawnText{.place = {label.x, label.y + 4},
                          .text = markText(level),
                          .anchor = TextAnchor::middle,
                          .size = 12,
                          .bold = true,
                          .haloed = true});
    taken.push_back(label);
}

std::string figuresOf(const GridValues& grid) {
    double sum = 0;
    for (const double value : grid.values) sum += value;
    const auto [least, largest] = std::minmax_element(grid.values.begin(), grid.values.end());
    return fmt::format("{} × {} points: minimum {:.4g}, mean {:.4g}, maximum {:.4g} {}", grid.nx, grid.ny, *least,
                       sum / static_cast<double>(grid.values.size()), *largest, grid.unit);
}

} // namespace

ValueScale scaleOfGrid(const GridValues& grid, bool logarithmic) { return closeScale(grid.values, logarithmic); }

Drawing isoluxDrawing(const GridValues& grid, const FalseColours& colours, std::vector<double> levels,
                      const std::string& title) {
    if (levels.empty()) levels = colours.scale.marks();
    const Frame frame = frameOf(grid);
    const double tall = std::max(frame.height, leastHeight);
    const Field field = fieldOf(grid), fine = refined(field);
    Drawing drawing{frame.width + 3 * rim + legendWidth, tall + 2 * rim + footer, title, {}};
    drawing.add(colouredField(field, frame, colours));
    std::vector<Place> taken = placesOfNumbers(grid, frame);
    addNumbers(drawing, grid, taken);
    for (const double level : levels)
        for (auto& line : contoursOf(fine, level)) addLine(drawing, std::move(line), frame, level, taken);
    addLegend(drawing, {frame.width + 2 * rim, rim}, tall, colours, grid.unit, beyondScale(grid.values, colours.scale));
    drawing.add(DrawnText{.place = {rim, tall + 2 * rim + 12}, .text = figuresOf(grid)});
    drawing.add(
        DrawnText{.place = {rim, tall + 2 * rim + 30},
                  .text = fmt::format("{:.4g} × {:.4g}, edge-u to the right, edge-v up", grid.lengthU, grid.lengthV),
                  .colour = midGrey,
                  .size = 11});
    return drawing;
}

} // namespace quasilux
