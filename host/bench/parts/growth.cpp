#include "bench/parts/growth.h"

#include "bench/parts/growth_scene.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace quasilux {

namespace {

/// What stays as it is while one thing grows.
struct Task {
    unsigned triangles = 10'000, photons = 200'000, resolution = 256, bdd = 0;
};

struct Size {
    double size;
    Task task;
};

// A task for each value of one of its members, and how large it is by that value.
std::vector<Size> sizesBy(unsigned Task::*member, const std::vector<unsigned>& values, double (*sizeOf)(double)) {
    std::vector<Size> sizes;
    for (const unsigned value : values) {
        Task task;
        task.*member = value;
        sizes.push_back({sizeOf(value), task});
    }
    return sizes;
}

// Steps alike in logarithms, so that none weighs more in the exponent.
std::vector<Size> sizesOf(const std::string& subject) {
    const auto itself = [](double value) { return value; };
    if (subject == "triangles")
        return sizesBy(&Task::triangles, {100, 520, 2700, 14'000, 73'000, 380'000, 2'000'000}, itself);
    if (subject == "photons")
        return sizesBy(&Task::photons, {10'000, 32'000, 100'000, 320'000, 1'000'000, 3'200'000, 10'000'000}, itself);
    if (subject == "pixels")
        return sizesBy(&Task::resolution, {32, 64, 128, 256, 512, 1024}, [](double side) { return side * side; });
    return sizesBy(&Task::bdd, {0, 1, 3, 7, 15}, [](double bdd) { return 1 + bdd; });
}

} // namespace

const std::vector<std::string>& growthSubjects() {
    static const std::vector<std::string> subjects{"triangles", "photons", "pixels", "bdd"};
    return subjects;
}

GrowthSeries measureGrowth(const std::string& subject, int device, unsigned steps, double seconds,
                           const std::function<void(double)>& onSize, const std::atomic<bool>& interrupted) {
    GrowthSeries series;
    series.subject = subject;
    series.isCpu = Device(device).info().isCpu;
    auto sizes = sizesOf(subject);
    sizes.resize(std::min<size_t>(sizes.size(), steps));
    for (const auto& [size, task] : sizes) {
        if (interrupted) {
            series.stopped = "interrupted";
            return series;
        }
        onSize(size);
        const Scene scene = growthScene(task.triangles, task.resolution);
        RenderSettings settings = settingsFromScene(scene);
        settings.photonsPerPass = task.photons;
        settings.bdd = task.bdd;
        // What does not fit the device ends the series, not the report.
        const auto refused = refusal([&, size = size] { // clang 14 captures no structured binding otherwise
            series.points.push_back({size, measurePass(device, scene, settings, seconds)});
        });
        if (refused) {
            series.stopped = fmt::format("{:g}: {}", size, *refused);
            return series;
        }
    }
    return series;
}

} // namespace quasilux
