#include "bench/parts/device_comparison.h"

#include "bench/bench_run.h"
#include "compare/measures.h"
#include "render/camera_stage.h"
#include "util/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr unsigned comparedPasses = 4;
constexpr double coldSeconds = 0.1; // only its first pass matters

/// The variables by which PoCL and NVIDIA's driver keep compiled kernels in this folder.
std::vector<std::pair<std::string, std::string>> cacheIn(const std::filesystem::path& folder) {
    return {{"POCL_CACHE_DIR", folder.string()}, {"CUDA_CACHE_PATH", folder.string()}};
}

FilmImage imageOf(const Scene& scene, int device) {
    TimedRenderer timed(device, scene, settingsFromScene(scene));
    for (unsigned pass = 0; pass < comparedPasses; ++pass) timed.pass(pass);
    return timed.renderer().develop();
}

SamePassDifference differenceOf(const FilmImage& image, const FilmImage& reference) {
    const auto comparison = compareImages(radianceOf(image), radianceOf(reference),
                                          {wholePicture(image.width, image.height)}, {.worstPixels = 0});
    const RegionMeasures& whole = comparison.regions.at(0);
    SamePassDifference difference;
    difference.mean = whole.relativeBias();
    difference.rms = std::sqrt(whole.relMse);
    difference.ofNoise = difference.rms / estimateError(reference).total.noiseRms;
    return difference;
}

json differenceJson(const std::optional<SamePassDifference>& difference) {
    if (!difference) return {};
    return {{"mean", difference->mean},
            {"rms", difference->rms},
            {"rmsOfNoise", difference->ofNoise},
            {"within", difference->isWithin()},
            {"tolerance",
             {{"mean", SamePassDifference::meanTolerance}, {"rmsOfNoise", SamePassDifference::noiseTolerance}}}};
}

std::string differenceText(const std::optional<SamePassDifference>& difference) {
    if (!difference) return "reference";
    return fmt::format("mean {:+.4f} %, rms {:.3g} % ({:.2g} of noise): {}", 100 * difference->mean,
                       100 * difference->rms, difference->ofNoise, difference->isWithin() ? "within" : "BEYOND");
}

double rate(uint64_t count, const std::map<std::string, double>& kernels, const std::string& kernel) {
    const auto found = kernels.find(kernel);
    return found == kernels.end() ? 0 : static_cast<double>(count) / found->second;
}

std::string rateText(double perSecond) { return perSecond > 0 ? fmt::format("{:.3g}", perSecond) : ""; }

} // namespace

bool SamePassDifference::isWithin() const {
    // Equal images may be black, without a mean or noise to compare with.
    return rms == 0 || (std::abs(mean) <= meanTolerance && ofNoise <= noiseTolerance);
}

std::vector<DeviceResult> compareDevices(const PartScene& scene, const std::vector<int>& devices, double seconds,
                                         const OnStep& onStep) {
    std::vector<DeviceResult> results;
    std::optional<FilmImage> reference;
    for (size_t place = 0; place < devices.size(); ++place) {
        const int device = devices[place];
        DeviceResult result;
        result.scene = scene.path;
        result.device = place;
        const TemporaryFolder cache;
        onStep(fmt::format("{}, device {}, nothing compiled yet", scene.path, place));
        result.cold = measureInChild(scene, device, coldSeconds, cacheIn(cache.path()));
        onStep(fmt::format("{}, device {}, kernels compiled", scene.path, place));
        result.warm = measureInChild(scene, device, seconds, cacheIn(cache.path()));
        onStep(fmt::format("{}, device {}, image", scene.path, place));
        const FilmImage image = imageOf(*scene.scene, device);
        if (reference)
            result.difference = differenceOf(image, *reference);
        else
            reference = image;
        results.push_back(result);
    }
    return results;
}

BenchSection deviceSection(const std::vector<DeviceResult>& all) {
    BenchSection section{"deviceComparison", "Devices", json::array(), {}};
    std::vector<TableRow> rows{{"scene", "device", "ms a pass", "CPU ms", "photons/s", "camera paths/s",
                                "compile, cold", "compile, warm", "J a pass", "image against the first device"}};
    for (const DeviceResult& one : all) {
        const PassTimes& least = one.warm.least;
        const double photons = rate(one.warm.photons, least.kernelCosts, "tracePhotons");
        const double paths = rate(one.warm.cameraPaths, least.kernelCosts, cameraKernel);
        rows.push_back({one.scene, std::to_string(one.device), fmt::format("{:.1f}", 1e3 * least.clock),
                        fmt::format("{:.1f}", 1e3 * least.cpu), rateText(photons), rateText(paths),
                        fmt::format("{:.2f} s", one.cold.compiling()), fmt::format("{:.2f} s", one.warm.compiling()),
                        least.joules ? fmt::format("{:.3g}", *least.joules) : "not reported",
                        differenceText(one.difference)});
        section.figures.push_back({{"scene", one.scene},
                                   {"device", one.device},
                                   {"photonsPerSecond", photons > 0 ? json(photons) : json()},
                                   {"cameraPathsPerSecond", paths > 0 ? json(paths) : json()},
                                   {"compileCold", one.cold.compiling()},
                                   {"compileWarm", one.warm.compiling()},
                                   {"joulesPerPass", least.joules ? json(*least.joules) : json()},
                                   {"pass", passMeasurementJson(one.warm)},
                                   {"difference", differenceJson(one.difference)}});
    }
    section.tables.push_back(
        {"the same work on each device", "", rows,
         fmt::format(
             "Rates: of the kernels that trace photons and camera paths, of CPU devices by CPU second; the least of "
             "several passes. "
             "Images: {} passes of the same numbers; within is a mean to {:g} % and a distance below {:g} of "
             "the noise.",
             comparedPasses, 100 * SamePassDifference::meanTolerance, SamePassDifference::noiseTolerance)});
    return section;
}

} // namespace quasilux
