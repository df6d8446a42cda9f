#include "prepare/filter_table.h"

#include <cmath>

namespace quasilux {

namespace {

constexpr int placesPerCell = 16; // of the midpoint rule: filters are smooth but for a few corners

// Mean of the filter over the cell that begins at `lower`, pixels from the centre.
double meanOverCell(const Sensor& sensor, double lower) {
    double sum = 0;
    for (int k = 0; k < placesPerCell; ++k) {
        const double x = std::abs(lower + (k + 0.5) / (placesPerCell * FILTER_CELLS));
        if (x < sensor.filterRadius) sum += sensor.filterShape(x);
    }
    return sum / placesPerCell;
}

} // namespace

bool needsFilterTable(const Sensor& sensor) {
    if (sensor.meter != MeterKind::none) return false; // its place in the pixel does not matter
    return sensor.filter == FILTER_TABLE;
}

unsigned filterReach(const Sensor& sensor) {
    return static_cast<unsigned>(std::ceil(sensor.filterRadius * FILTER_CELLS));
}

std::vector<shared::FilterStep> filterTable(const Sensor& sensor) {
    if (!needsFilterTable(sensor)) return {};
    const int reach = static_cast<int>(filterReach(sensor));
    std::vector<double> cells;
    double total = 0;
    for (int k = -reach; k < reach; ++k) {
        cells.push_back(meanOverCell(sensor, double(k) / FILTER_CELLS));
        total += std::abs(cells.back());
    }
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
