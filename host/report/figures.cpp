#include "report/figures.h"

#include "scene/observer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasilux {

namespace {

using Points = BatchedReadings::Points;

double meanOf(const Points& points) {
    return std::accumulate(points.begin(), points.end(), 0.0) / static_cast<double>(points.size());
}
double leastOf(const Points& points) { return *std::min_element(points.begin(), points.end()); }
double largestOf(const Points& points) { return *std::max_element(points.begin(), points.end()); }
double first(const Points& points) { return points.front(); }

Points partOf(const Points& points, PixelRange range) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(range.first);
    return {first, first + static_cast<std::ptrdiff_t>(range.count)};
}

/// The point that one half of the passes says is least (of `sign` times the values), by the other half, and the other
/// way round: the mean of both is that of a real point, so a least one is no less than the minimum of the true values.
double crossed(const BatchedReadings& readings, PixelRange range, double sign) {
    const auto halves = readings.halves();
    const Points a = partOf(halves.first, range), b = partOf(halves.second, range);
    const auto placeOfLeast = [&](const Points& points) {
        return static_cast<size_t>(
            std::min_element(points.begin(), points.end(), [&](double x, double y) { return sign * x < sign * y; }) -
            points.begin());
    };
    return (b[placeOfLeast(a)] + a[placeOfLeast(b)]) / 2;
}

// From the lamp to the eye (Scene::maxDepth).
constexpr int segmentsOfDirectLight = 1;

/// Lamps behind them are no glare sources (Occlusion), so their light must be no direct light; through `null` surfaces
/// they are seen.
bool hasPanesOrMasks(const Scene& scene) {
    return std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(),
                       [](const Bsdf& bsdf) { return !bsdf.isNull && bsdf.letsPass(); });
}

/// Of two independent figures.
Figure difference(const Figure& a, const Figure& b) {
    return {a.value - b.value, std::hypot(a.standardError, b.standardError), std::min(a.batches, b.batches)};
}

} // namespace

namespace {

/// Readings of all points of a grid and, where there are any, others of those that may be extreme.
struct GridReadings {
    struct Extreme {
        const BatchedReadings& readings;
        PixelRange range;
        bool isOwn; ///< of other readings than the mean
    };
    const BatchedReadings& all;
    PixelRange range;
    Extreme least, largest;

    /// What `rule` makes of the grid's points and of those that may be least and largest. Of independent readings the
    /// errors add up: each is the jackknife's with the means of the others.
    template <typename Rule>
    Figure figure(const Rule& rule) const {
        const auto with = [&](const Points& points, const Points& ofExtremes) {
            return rule(partOf(points, range), partOf(least.isOwn ? ofExtremes : points, least.range),
                        partOf(largest.isOwn ? ofExtremes : points, largest.range));
        };
        if (!least.isOwn && !largest.isOwn) return all.figure([&](const Points& points) { return with(points, {}); });
        const BatchedReadings& other = least.isOwn ? least.readings : largest.readings;
        const Points means = all.means(), extremes = other.means();
        const Figure a = all.figure([&](const Points&points) { return with(points, extremes); }),
                     b = other.figure([&](const Points&points) { return with(means, points); });
        return {a.value, std::hypot(a.standardError, b.standardError), std::min(a.batches, b.batches)};
    }
};

NormFigures normFigures(const GridReadings& grid) {
    const auto figure = [&](const auto& rule) { return grid.figure(rule); };
    NormFigures found{
        figure([](const Points& all, const Points&, const Points&) { return meanOf(all); }),
        figure([](const Points&, const Points& least, const Points&) { return leastOf(least); }),
        figure([](const Points&, const Points&, const Points& largest) { return largestOf(largest); }),
        figure([](const Points& all, const Points& least, const Points&) { return leastOf(least) / meanOf(all); }),
        figure([](const Points&, const Points& least, const Points& largest) {
            return leastOf(least) / largestOf(largest);
        })};
    if (!found.mean.isKnown() || !found.diversity.isKnown()) return found;
    const double least = crossed(grid.least.readings, grid.least.range, 1),
                 largest = crossed(grid.largest.readings, grid.largest.range, -1);
    found.minimum.bias = std::max(0.0, least - found.minimum.value);
    found.maximum.bias = std::min(0.0, largest - found.maximum.value);
    found.overall.bias = found.minimum.bias / found.mean.value;
    found.diversity.bias =
        (found.minimum.value + found.minimum.bias) / (found.maximum.value + found.maximum.bias) - found.diversity.value;
    return found;
}

} // namespace

NormFigures normFigures(const BatchedReadings& readings, PixelRange range) {
    return normFigures({readings, range, {readings, range, false}, {readings, range, false}});
}

NormFigures normFigures(const BatchedReadings& readings, PixelRange range, const BatchedReadings& extremes,
                        const ExtremeRanges& extremeRanges) {
    const auto extreme = [&](PixelRange own) -> GridReadings::Extreme {
        if (own.count == 0) return {readings, range, false};
        return {extremes, own, true};
    };
    return normFigures({readings, range, extreme(extremeRanges.least), extreme(extremeRanges.largest)});
}

Figure ratioOfMeans(const BatchedReadings& readings, PixelRange over, PixelRange under) {
    return readings.figure(
        [&](const Points& points) { return meanOf(partOf(points, over)) / meanOf(partOf(points, under)); });
}

PointModelling modellingAtPoints(const BatchedReadings& readings, PixelRange over, PixelRange under) {
    constexpr double leastOfNorm = 0.3, mostOfNorm = 0.6;
    const Points means = readings.means();
    PointModelling found;
    for (size_t k = 0; k < over.count; ++k) {
        if (!(means[under.first + k] > 0)) continue;
        const double ratio = means[over.first + k] / means[under.first + k];
        found.least = found.points == 0 ? ratio : std::min(found.least, ratio);
        found.largest = std::max(found.largest, ratio);
        found.within += ratio >= leastOfNorm && ratio <= mostOfNorm;
        ++found.points;
    }
    return found;
}

ObserverFigures observerFigures(const Observer& observer, const GlareSources& sources, const BatchedReadings& direct,
                                const BatchedReadings& all) {
    ObserverFigures found{observer, sources, direct.figure(first), {}, {}};
    found.indirect = difference(all.figure(first), found.direct);
    const GlareRating rating =
        unifiedGlareRating(sources.strength(), found.indirect.value, found.indirect.standardError);
    found.rating = {rating.value, rating.standardError, found.indirect.batches};
    return found;
}

bool areKnown(const NormFigures& figures, double share) {
    const Figure* all[] = {&figures.mean, &figures.minimum, &figures.maximum, &figures.overall, &figures.diversity};
    return std::all_of(std::begin(all), std::end(all),
                       [&](const Figure* figure) { return figure->relativeHalfWidth() <= share; });
}

bool isKnown(const ObserverFigures& figures, double share) {
    return figures.sources.seen.empty() || figures.rating.relativeHalfWidth() <= share;
}

void measureAtEye(Scene& scene, const Observer& observer, EyeLight light) {
    scene.surroundings.reset();
    scene.directionalEmitters.clear();
    scene.grids = {eyeGrid(observer)};
    if (light == EyeLight::direct) {
        scene.maxDepth = segmentsOfDirectLight;
        scene.countsPassages = hasPanesOrMasks(scene);
    }
    useGridsAsSensor(scene);
}

} // namespace quasilux
