#include "report/decisive_points.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr double standardErrors = 3;

/// Those that may be the least of `sign` times the values.
std::vector<size_t> mayBeLeast(const std::vector<double>& values, const std::vector<double>& errors, PixelRange range,
                               double sign) {
    double bound = INFINITY;
    for (size_t k = range.first; k < range.first + range.count; ++k)
        bound = std::min(bound, sign * values[k] + standardErrors * errors[k]);
    std::vector<size_t> points;
    for (size_t k = range.first; k < range.first + range.count; ++k)
        if (sign * values[k] - standardErrors * errors[k] <= bound) points.push_back(k - range.first);
    return points;
}

bool isKnownTo(const Figure& figure, double precision) { return figure.relativeHalfWidth() <= precision; }

/// How many times the time so far the extremes of a grid take, were all paths at all points; infinite where its mean is
/// not known either.
double timesSoFar(const NormFigures& figures, double precision) {
    const double ofMean = figures.mean.relativeHalfWidth(), left = precision * precision - ofMean * ofMean;
    if (!(left > 0)) return INFINITY;
    double widest = 0;
    for (const Figure* figure : {&figures.minimum, &figures.maximum, &figures.overall, &figures.diversity})
        widest = std::max(widest, figure->relativeHalfWidth());
    return widest * widest / left;
}

} // namespace

std::optional<std::vector<DecisivePoints>> decisivePoints(const BatchedReadings& readings,
                                                          const std::vector<PixelRange>& ranges, double precision) {
    constexpr double worthwhile = 2; // T(t) = t + C D(t) / N with D - D(inf) ~ t^(-1/2) is least about there
    const auto values = readings.means(), errors = readings.standardErrors();
    std::vector<DecisivePoints> decisive(ranges.size());
    double times = 0;
    size_t all = 0, chosen = 0;
    for (size_t g = 0; g < ranges.size(); ++g) {
        const NormFigures figures = normFigures(readings, ranges[g]);
        all += ranges[g].count;
        if (areKnown(figures, precision)) continue;
        times = std::max(times, timesSoFar(figures, precision));
        const bool isLeastKnown = isKnownTo(figures.minimum, precision) && isKnownTo(figures.overall, precision);
        const bool needsBoth = !isKnownTo(figures.diversity, precision);
        if (!isLeastKnown || needsBoth) decisive[g].least = mayBeLeast(values, errors, ranges[g], 1);
        if (!isKnownTo(figures.maximum, precision) || needsBoth)
            decisive[g].largest = mayBeLeast(values, errors, ranges[g], -1);
        chosen += decisive[g].count();
    }
    if (chosen == 0 || !(times * double(chosen) <= worthwhile * double(all))) return std::nullopt;
    return decisive;
}

std::vector<IlluminanceGrid> gridsOf(const std::vector<IlluminanceGrid>& grids,
                                     const std::vector<DecisivePoints>& decisive) {
    std::vector<IlluminanceGrid> points;
    const auto add = [&](const IlluminanceGrid& grid, const std::vector<size_t>& numbers) {
        for (const size_t number : numbers) {
            IlluminanceGrid point = grid;
            point.edgeU = grid.edgeU / double(grid.nx);
            point.edgeV = grid.edgeV / double(grid.ny);
            const size_t column = number % grid.nx, row = number / grid.nx;
            point.origin = grid.origin + double(column) * point.edgeU + double(row) * point.edgeV;
            point.nx = point.ny = 1;
            points.push_back(point);
        }
    };
    for (size_t g = 0; g < grids.size(); ++g) {
        add(grids[g], decisive[g].least);
        add(grids[g], decisive[g].largest);
    }
    return points;
}

std::vector<ExtremeRanges> extremeRanges(const std::vector<DecisivePoints>& decisive) {
    std::vector<ExtremeRanges> ranges;
    size_t next = 0;
    const auto take = [&](size_t count) {
        next += count;
        return PixelRange{next - count, count};
    };
    for (const DecisivePoints& points : decisive) {
        const PixelRange least = take(points.least.size());
        ranges.push_back({least, take(points.largest.size())});
    }
    return ranges;
}

} // namespace quasilux
