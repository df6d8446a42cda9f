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

// Steps alike in logarithms, so that none weighs more in the exponent.
std::vector<Size> trianglesGrow() {
    std::vector<Size> sizes;
    for (const unsigned n : {100u, 520u, 2700u, 14'000u, 73'000u, 380'000u, 2'000'000u}) {
        Task task;
        task.triangles = n;
        sizes.push_back({double(n), task});
    }
    return sizes;
}

std::vector<Size> photonsGrow() {
    std::vector<Size> sizes;
    for (const unsigned n : {10'000u, 32'000u, 100'000u, 320'000u, 1'000'000u, 3'200'000u, 10'000'000u}) {
        Task task;
        task.photons = n;
        sizes.push_back({double(n), task});
    }
    return sizes;
}

std::vector<Size> pixelsGrow() {
    std::vector<Size> sizes;
    for (const unsigned side : {32u, 64u, 128u, 256u, 512u, 1024u}) {
        Task task;
        task.resolution = side;
        sizes.push_back({double(side) * side, task});
    }
    return sizes;
}

std::vector<Size> bddGrows() {
    std::vector<Size> sizes;
    for (const unsigned bdd : {0u, 1u, 3u, 7u, 15u}) {
        Task task;
        task.bdd = bdd;
        sizes.push_back({1.0 + bdd, task});
    }
    return sizes;
}

std::vector<Size> sizesOf(const std::string& subject) {
    if (subject == "triangles") return trianglesGrow();
    if (subject == "photons") return photonsGrow();
    return subject == "pixels" ? pixelsGrow() : bddGrows();
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
        try {
            series.points.push_back({size, measurePass(device, scene, settings, seconds)});
        } catch (const DeviceError& error) { // what a device has no memory for ends the series, not the report
            series.stopped = fmt::format("{:g}: {}", size, error.what());
            return series;
        }
    }
    return series;
}

} // namespace quasilux
