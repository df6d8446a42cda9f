#include "bench/bench_run.h"

#include "compare/measures.h"
#include "util/process_memory.h"

#include <chrono>
#include <cmath>
#include <sys/resource.h>

namespace quasilux {

namespace {

constexpr unsigned firstPoint = 4;    // passes before an error estimate means anything
constexpr unsigned firstOfSlope = 16; // before it the first radii weigh too much

double clockSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

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
    Device opened(device);
    Renderer renderer(opened, scene, run.settings);
    double clock = 0, cpu = 0;
    unsigned passes = 0, next = firstPoint;
    const auto addPoint = [&] {
        run.image = renderer.develop();
        BenchPoint point{passes, clock, cpu, estimateError(run.image), std::nullopt};
        if (reference) point.relMse = relMseOf(run.image, *reference);
        run.points.push_back(point);
    };
    while (passes == 0 || (clock < seconds && !interrupted)) {
        const double clockBefore = clockSeconds(), cpuBefore = processSeconds();
        renderer.renderPass(passes++);
        opened.finish();
        clock += clockSeconds() - clockBefore;
        cpu += processSeconds() - cpuBefore;
        onProgress(passes, clock);
        if (passes != next) continue;
        addPoint();
        next *= 2;
    }
    if (run.points.empty() || run.points.back().passes != passes) addPoint();
    run.counters = renderer.counters();
    run.kernels = opened.timings();
    run.peakBufferBytes = opened.allocatedBytes();
    run.peakHostBytes = peakResidentBytes();
    return run;
}

std::optional<double> convergenceSlope(const BenchRun& run) {
    double n = 0, sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
    for (const BenchPoint& point : run.points) {
        if (point.passes < firstOfSlope || !isKnown(errorOf(point))) continue;
        const double x = std::log(point.seconds), y = std::log(errorOf(point));
        n += 1;
        sumX += x;
        sumY += y;
        sumXX += x * x;
        sumXY += x * y;
    }
    const double spread = n * sumXX - sumX * sumX;
    if (n < 3 || !(spread > 0)) return std::nullopt;
    return (n * sumXY - sumX * sumY) / spread;
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
