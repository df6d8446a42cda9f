// The figures of norms, each with its error (docs/method/glare.md).
#pragma once

#include "output/meter_reading.h"
#include "photometry/glare.h"
#include "report/batched_readings.h"

#include <string>

namespace quasilux {

/// EN 12464-1: of the points of a grid.
struct NormFigures {
    Figure mean, minimum, maximum; ///< lx
    Figure overall, diversity;     ///< U0 = minimum / mean, Ud = minimum / maximum
};
/// Of some of the points.
NormFigures normFigures(const BatchedReadings& readings, PixelRange range);

/// Points that may be the darkest and the brightest of a grid; none: all of the grid's may.
struct ExtremeRanges {
    PixelRange least, largest;
};
/// The same with the extremes of other, independent readings, which have these points.
NormFigures normFigures(const BatchedReadings& readings, PixelRange range, const BatchedReadings& extremes,
                        const ExtremeRanges& extremeRanges);

/// Ratio of the means of two grids.
Figure ratioOfMeans(const BatchedReadings& readings, PixelRange over, PixelRange under);

/// Modelling at single points, which EN 12464-1 wants between 0.30 and 0.60.
struct PointModelling {
    double least = 0, largest = 0;
    size_t within = 0, points = 0; ///< those between, all with light
};
PointModelling modellingAtPoints(const BatchedReadings& readings, PixelRange over, PixelRange under);

/// Of one observer.
struct ObserverFigures {
    Observer observer;
    GlareSources sources;
    Figure direct;   ///< vertical illuminance at the eye by the lamps' direct light, lx
    Figure indirect; ///< by all other light
    Figure rating;   ///< UGR; -infinity where no luminaire is seen
};
/// `direct`, `all`: readings at the eye by measureAtEye(), independent of each other.
ObserverFigures observerFigures(const Observer& observer, const GlareSources& sources, const BatchedReadings& direct,
                                const BatchedReadings& all);

/// Whether each is known to this share of its value, with 95 %; a UGR where nothing glares counts as known.
bool areKnown(const NormFigures& figures, double share);
bool isKnown(const ObserverFigures& figures, double share);

enum class EyeLight { direct, all };
/// The scene as its observer's eye measures it: lamps alone, without sky and sun, which the rating is not of.
void measureAtEye(Scene& scene, const Observer& observer, EyeLight light);

} // namespace quasilux
