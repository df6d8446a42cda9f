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

/// The point that one half of the passes says is extreme, by the other half, and the other way round: the mean of both
/// is that of a real point, so it is no less than the minimum of the true values, and no more than the maximum.
struct Crossed {
    double least, largest;
};
Crossed crossed(const BatchedReadings& readings, PixelRange range) {
    const auto halves = readings.halves();
    const Points a = partOf(halves.first, range), b = partOf(halves.second, range);
    const auto placeOf = [](const Points& points, auto place) { return static_cast<size_t>(place - points.begin()); };
    const auto least = [&](const Points& by) { return placeOf(by, std::min_element(by.begin(), by.end())); };
    const auto largest = [&](const Points& by) { return placeOf(by, std::max_element(by.begin(), by.end())); };
    return {(b[least(a)] + a[least(b)]) / 2, (b[largest(a)] + a[largest(b)]) / 2};
}

// From the lamp to the eye (Scene::maxDepth).
constexpr int segmentsOfDirectLight = 1;

/// Of two independent figures.
Figure difference(const Figure& a, const Figure& b) {
    return {a.value - b.value, std::hypot(a.standardError, b.standardError), std::min(a.batches, b.batches)};
}

} // namespace

NormFigures normFigures(const BatchedReadings& readings, PixelRange range) {
    const auto figure = [&](const BatchedReadings::Rule& rule) {
        return readings.figure([&](const Points& points) { return rule(partOf(points, range)); });
    };
    NormFigures found{figure(meanOf), figure(leastOf), figure(largestOf),
                      figure([](const Points& p) { return leastOf(p) / meanOf(p); }),
                      figure([](const Points& p) { return leastOf(p) / largestOf(p); })};
    if (!found.mean.isKnown()) return found;
    const Crossed real = crossed(readings, range);
    found.minimum.bias = std::max(0.0, real.least - found.minimum.value);
    found.maximum.bias = std::min(0.0, real.largest - found.maximum.value);
    found.overall.bias = found.minimum.bias / found.mean.value;
    found.diversity.bias =
        (found.minimum.value + found.minimum.bias) / (found.maximum.value + found.maximum.bias) - found.diversity.value;
    return found;
}

Figure ratioOfMeans(const BatchedReadings& readings, PixelRange over, PixelRange under) {
    return readings.figure(
        [&](const Points& points) { return meanOf(partOf(points, over)) / meanOf(partOf(points, under)); });
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
    if (light == EyeLight::direct) scene.maxDepth = segmentsOfDirectLight;
    useGridsAsSensor(scene);
}

} // namespace quasilux
