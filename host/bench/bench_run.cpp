#include "bench/bench_run.h"

#include "bench/pass_times.h"
#include "bench/power_law.h"
#include "compare/measures.h"
#include "util/process_memory.h"

#include <cmath>

namespace quasilux {

namespace {

constexpr unsigned firstPoint = 4;    // passes before an error estimate means anything
constexpr unsigned firstOfSlope = 16; // before it the first radii weigh too much

double relMseOf(const FilmImage& image, const BenchReference& reference) {
    CompareSettings settings;
    settings.referenceNoise[""] = reference.noise;
    settings.worstPixels = 0;
    return compareImages(radianceOf(image), reference.image, {wholePicture(image.width, image.height)}, settings)
        .regions.at(0)
        .netRelMse;
}

double errorOf(const BenchPoint& point) { return point.relMse.value_or(point.estimate.relativeMse()); }

bool isKnown(double error) { return std::isfinite(error) && error > 0; }

} // namespace

RadianceImage radianceOf(const FilmImage& image) {
    RadianceImage radiance;
    radiance.width = image.width;
    radiance.height = image.height;
    radiance.radiance = image.radiance;
    radiance.standardError = image.standardError;
    return radiance;
}

BenchRun measureRun(int device, const Scene& scene, const BenchMethod& method, double seconds,
                    const BenchReference* reference, const std::function<void(unsigned, double)>& onProgress,
                    const std::atomic<bool>& interrupted) {
    BenchRun run;
    run.method = method.name;
    run.settings = settingsFromScene(scene);
    method.apply(run.settings);
    TimedRenderer timed(device, scene, run.settings);
    Renderer& renderer = timed.renderer();
    double clock = 0, cpu = 0;
    unsigned passes = 0, next = firstPoint;
    const auto addPoint = [&] {
        run.image = renderer.develop();
        BenchPoint point{passes, clock, cpu, estimateError(run.image), std::nullopt};
        if (reference) point.relMse = relMseOf(run.image, *reference);
        run.points.push_back(point);
    };
    while (passes == 0 || (clock < seconds && !interrupted)) {
        const PassTimes times = timed.pass(passes++);
        clock += times.clock;
        cpu += times.cpu;
        if (times.joules) run.joules = run.joules.value_or(0) + *times.joules;
        onProgress(passes, clock);
        if (passes != next) continue;
        addPoint();
        next *= 2;
    }
    if (run.points.empty() || run.points.back().passes != passes) addPoint();
    run.counters = renderer.counters();
    run.kernels = timed.device().timings();
    run.peakBufferBytes = timed.device().peakBytes();
    run.peakHostBytes = peakResidentBytes();
    return run;
}

std::optional<double> convergenceSlope(const BenchRun& run) {
    std::vector<std::pair<double, double>> points;
    for (const BenchPoint& point : run.points)
        if (point.passes >= firstOfSlope) points.emplace_back(point.seconds, errorOf(point));
    const auto law = fitPowerLaw(points);
    return law ? std::optional(law->exponent) : std::nullopt;
}

std::optional<TimeToError> timeToError(const BenchRun& run, double relativeError) {
    const double target = relativeError * relativeError;
    const BenchPoint* before = nullptr;
    for (const BenchPoint& point : run.points) {
        const double error = errorOf(point);
        if (!isKnown(error)) continue;
        if (error <= target) {
            if (!before) return TimeToError{point.seconds, false};
            const double from = std::log(errorOf(*before)), to = std::log(error);
            const double share = (from - std::log(target)) / (from - to);
            return TimeToError{before->seconds * std::pow(point.seconds / before->seconds, share), false};
        }
        before = &point;
    }
    if (!before) return std::nullopt;
    return TimeToError{before->seconds * errorOf(*before) / target, true};
}

} // namespace quasilux
