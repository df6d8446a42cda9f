#include "bench/pass_times.h"

#include "util/stopwatch.h"

#include <algorithm>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr size_t fewestPasses = 3;

} // namespace

TimedRenderer::TimedRenderer(int device, const Scene& scene, const RenderSettings& settings)
    : device_(device), renderer_(device_, scene, settings), energy_(device_.info()) {}

PassTimes TimedRenderer::pass(unsigned number) {
    const Stopwatch watch;
    const auto joulesBefore = energy_.joules();
    renderer_.renderPass(number);
    device_.finish();
    PassTimes times;
    times.clock = watch.seconds();
    times.cpu = watch.processorSeconds();
    if (const auto joules = energy_.joules(); joules && joulesBefore) times.joules = *joules - *joulesBefore;
    for (const auto& [kernel, timing] : device_.timings()) {
        double& before = kernelSeconds_[kernel];
        if (timing.seconds > before) times.kernels[kernel] = timing.seconds - before;
        before = timing.seconds;
    }
    const double share = times.cost(device_.info().isCpu) / times.clock;
    for (const auto& [kernel, seconds] : times.kernels) times.kernelCosts[kernel] = share * seconds;
    return times;
}

namespace {

void takeLeast(std::map<std::string, double>& least, const std::map<std::string, double>& others) {
    for (const auto& [kernel, seconds] : others) {
        const auto [known, isNew] = least.try_emplace(kernel, seconds);
        if (!isNew) known->second = std::min(known->second, seconds);
    }
}

} // namespace

PassTimes leastOf(const std::vector<PassTimes>& passes) {
    PassTimes least = passes.front();
    for (const PassTimes& pass : passes) {
        least.clock = std::min(least.clock, pass.clock);
        least.cpu = std::min(least.cpu, pass.cpu);
        if (pass.joules) least.joules = std::min(least.joules.value_or(*pass.joules), *pass.joules);
        takeLeast(least.kernels, pass.kernels);
        takeLeast(least.kernelCosts, pass.kernelCosts);
    }
    return least;
}

PassMeasurement measurementOf(TimedRenderer& timed) {
    const RenderCounters& counters = timed.renderer().counters();
    PassMeasurement measured;
    measured.prepare = counters.prepareSeconds;
    measured.compile = counters.compileSeconds;
    measured.firstPass = counters.firstPassSeconds;
    measured.bufferBytes = timed.device().peakBytes();
    measured.triangles = timed.renderer().report().triangles;
    measured.photons = counters.photonsEmitted / counters.passes;
    measured.cameraPaths = counters.cameraPaths / counters.passes;
    return measured;
}

PassMeasurement measurePass(int device, const Scene& scene, RenderSettings settings, double seconds) {
    settings.radius = RadiusChoice::fixed; // radii by pixel follow the scatter of passes, and the same pass has none
    TimedRenderer timed(device, scene, settings);
    timed.pass(0);
    std::vector<PassTimes> passes;
    for (double spent = 0; passes.size() < fewestPasses || spent < seconds; spent += passes.back().clock)
        passes.push_back(timed.pass(0));
    PassMeasurement measured = measurementOf(timed);
    measured.least = leastOf(passes);
    return measured;
}

json passMeasurementJson(const PassMeasurement& measured) {
    const PassTimes& least = measured.least;
    return {{"prepare", measured.prepare},
            {"compile", measured.compile},
            {"firstPass", measured.firstPass},
            {"clock", least.clock},
            {"cpu", least.cpu},
            {"kernels", least.kernels},
            {"kernelCosts", least.kernelCosts},
            {"joules", least.joules ? json(*least.joules) : json()},
            {"bufferBytes", measured.bufferBytes},
            {"triangles", measured.triangles},
            {"photons", measured.photons},
            {"cameraPaths", measured.cameraPaths}};
}

PassMeasurement passMeasurementFromJson(const json& from) {
    PassMeasurement measured;
    measured.prepare = from.at("prepare");
    measured.compile = from.at("compile");
    measured.firstPass = from.at("firstPass");
    measured.least.clock = from.at("clock");
    measured.least.cpu = from.at("cpu");
    measured.least.kernels = from.at("kernels").get<std::map<std::string, double>>();
    measured.least.kernelCosts = from.at("kernelCosts").get<std::map<std::string, double>>();
    if (!from.at("joules").is_null()) measured.least.joules = from.at("joules").get<double>();
    measured.bufferBytes = from.at("bufferBytes");
    measured.triangles = from.at("triangles");
    measured.photons = from.at("photons");
    measured.cameraPaths = from.at("cameraPaths");
    return measured;
}

} // namespace quasilux
