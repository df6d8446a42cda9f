#include "prepare/filter_table.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr int placesPerCell = 16; // of the midpoint rule: filters are smooth but for a few corners

// Integral of the filter over cell k, counted from the centre, in cells; the last one may end at the filter's radius.
double overCell(const Sensor& sensor, unsigned k) {
    const double lower = double(k) / FILTER_CELLS, upper = std::min(double(k + 1) / FILTER_CELLS, sensor.filterRadius);
    double sum = 0;
    for (int place = 0; place < placesPerCell; ++place)
        sum += sensor.filterShape(lower + (place + 0.5) / placesPerCell * (upper - lower));
    return sum / placesPerCell * (upper - lower) * FILTER_CELLS;
}

// From the left end to the right one.
std::vector<double> cellsOf(const Sensor& sensor) {
    const unsigned reach = filterReach(sensor);
    std::vector<double> cells;
    for (unsigned k = reach; k > 0; --k) cells.push_back(overCell(sensor, k - 1));
    for (unsigned k = 0; k < reach; ++k) cells.push_back(overCell(sensor, k));
    return cells;
}

} // namespace

bool needsFilterTable(const Sensor& sensor) {
    if (sensor.meter != MeterKind::none) return false; // its place in the pixel does not matter
    return sensor.filter == FILTER_TABLE;
}

unsigned filterReach(const Sensor& sensor) {
    return static_cast<unsigned>(std::ceil(sensor.filterRadius * FILTER_CELLS));
}

bool gainsBySharing(const Sensor& sensor) {
    if (!needsFilterTable(sensor)) return false;
    double magnitude = 0, squares = 0;
    for (const double cell : cellsOf(sensor)) {
        magnitude += std::abs(cell);
        squares += cell * cell;
    }
    return FILTER_CELLS * squares < magnitude * magnitude;
}

std::vector<shared::FilterStep> filterTable(const Sensor& sensor) {
    if (!needsFilterTable(sensor)) return {};
    const std::vector<double> cells = cellsOf(sensor);
    double total = 0;
    for (const double cell : cells) total += std::abs(cell);
    std::vector<shared::FilterStep> steps{{0, 0}};
    double magnitude = 0, value = 0;
    for (const double cell : cells) {
        magnitude += std::abs(cell) / total;
        value += cell / total;
        steps.push_back({static_cast<float>(magnitude), static_cast<float>(value)});
    }
    return steps;
}

} // namespace quasilux
