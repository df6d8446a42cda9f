// Points that may be the darkest or brightest of a grid: minimum, U0 and Ud hang on them alone, while all points share
// in the mean. So these are measured once more, apart, when it is known which they are (docs/method/glare.md,
// "Points that decide").
#pragma once

#include "report/figures.h"

#include <optional>
#include <vector>

namespace quasilux {

/// Numbers of a grid's points that may be its minimum and maximum; empty where that figure need not be known better.
struct DecisivePoints {
    std::vector<size_t> least, largest;

    size_t count() const { return least.size() + largest.size(); }
};

/// Of each grid (`ranges`), where its figures are not known to `precision`: points within 3 standard errors of the
/// extreme, so that 1 in 700 may be left out by chance; it is the darkest or brightest of those measured once more then.
/// Nothing as long as it pays to go on with all points: what the decisive ones take is forecast by their share of the
/// points, and the best time for the change is when that is twice what has passed.
std::optional<std::vector<DecisivePoints>> decisivePoints(const BatchedReadings& readings,
                                                          const std::vector<PixelRange>& ranges, double precision);

/// Grids of one point each, in the order of `decisive`, first the least ones of a grid, then its largest.
std::vector<IlluminanceGrid> gridsOf(const std::vector<IlluminanceGrid>& grids,
                                     const std::vector<DecisivePoints>& decisive);

/// Where the readings of those grids have the points of each grid.
std::vector<ExtremeRanges> extremeRanges(const std::vector<DecisivePoints>& decisive);

} // namespace quasilux
