// How the cost of a pass grows with what it is asked to do, one thing at a time, on scenes made in code.
#pragma once

#include "bench/bench_section.h"
#include "bench/pass_times.h"

#include <atomic>
#include <functional>

namespace quasilux {

/// What grows: "triangles", "photons" (a pass), "pixels", "bdd".
struct GrowthSeries {
    std::string subject;
    size_t device = 0; ///< place in the list that was asked for
    bool isCpu = true;
    struct Point {
        double size = 0; ///< how many; of the BDD one more, the diffuse hits of a camera path
        PassMeasurement measured;
    };
    std::vector<Point> points;
    std::string stopped; ///< why larger sizes are missing; empty if none are
};

/// Names that measureGrowth takes.
const std::vector<std::string>& growthSubjects();

/// The first `steps` sizes, each for `seconds`. `onSize` gets each before it is measured.
GrowthSeries measureGrowth(const std::string& subject, int device, unsigned steps, double seconds,
                           const std::function<void(double)>& onSize, const std::atomic<bool>& interrupted);

/// "growth": costs by size, a plot and the exponents of each series.
BenchSection growthSection(const std::vector<GrowthSeries>& all);

} // namespace quasilux
