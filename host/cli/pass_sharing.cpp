#include "cli/pass_sharing.h"

#include "cli/interrupt.h"
#include "cli/render_scene.h"
#include "learn/learned_state.h"
#include "ranks/job.h"
#include "share/device_workers.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// What a renderer is made from, besides its device.
struct RendererPlan {
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;
    std::shared_ptr<const LearnedScene> learned;
    SceneChecksums checksums;
};

OpenedRenderer openRenderer(std::shared_ptr<Device> device, const RendererPlan& plan) {
    auto renderer = std::make_shared<Renderer>(*device, *plan.scene, plan.settings, plan.learned, plan.checksums);
    renderer->clearPasses();
    return {std::move(device), std::move(renderer)};
}

void addDevices(DeviceWorkers& workers, const RenderOptions& options, const std::vector<DeviceChoice>& choices,
                const RendererPlan& plan) {
    for (const DeviceChoice& choice : choices)
        workers.add(text(choice), [options, choice, plan] { return openRenderer(openDevice(options, choice), plan); });
}

double answerSeconds(const RenderOptions& options) { return options.answerSeconds.value_or(usualAnswerSeconds); }

} // namespace

std::vector<DeviceChoice> ownDevices(const RenderOptions& options) {
    const auto all = devicesOf(options.devices, options.devices.empty() ? 1 : listDevices().size());
    const Job& job = Job::current();
    return shareOf(all, job.localRank(), job.localSize());
}

std::shared_ptr<Device> openDevice(const RenderOptions& options, const DeviceChoice& choice) {
    return std::make_shared<Device>(choice, options.workGroupSize, options.deviceMemory);
}

// Others have the kernels compiled while the first one renders the passes from which radii are chosen.
std::unique_ptr<PassWorkers> PassSharing::workers(const ChosenRender& chosen) const {
    const auto& renderer = chosen.renderer;
    auto own = std::make_unique<DeviceWorkers>(answerSeconds(options_));
    own->add(text(devices_.choices.front()), [device = devices_.first, renderer] {
        return OpenedRenderer{device, renderer};
    });
    const RendererPlan plan{devices_.scene, chosen.soFar.settings, renderer->learned(), renderer->report().checksums};
    addDevices(*own, options_, {devices_.choices.begin() + 1, devices_.choices.end()}, plan);
    RankPlan ofRanks{options_.sensor, plan.settings, plan.checksums, renderer->filmShape(), {}};
    saveLearned(ofRanks.learned, *plan.learned);
    return Job::current().spread(std::move(own), ofRanks);
}

RenderOutcome PassSharing::run(const ChosenRender& chosen) {
    Renderer& renderer = *chosen.renderer;
    // Where no pass follows, this is the last time: of no sums there is none at the end.
    keeper_.afterPass(chosen.soFar, renderer, chosen.seconds, chosen.interrupted);
    SharedStart start;
    start.passes = {chosen.stop.firstPass, std::max(renderer.nextPass(), chosen.stop.firstPass)};
    start.seconds = chosen.seconds;
    renderer.saveRadii(start.radii);
    start.sums = takeSums(*devices_.first, renderer);
    report_ = renderer.report();
    const auto all = workers(chosen);
    SharedRender shared(*all, std::move(start), chosen.stop, hooks(chosen), chosen.interrupted);
    RenderOutcome outcome = shared.run();
    records_ = shared.workers();
    timings_ = shared.sums().timings;
    return outcome;
}

SharedHooks PassSharing::hooks(const ChosenRender& chosen) {
    SharedHooks hooks;
    hooks.onProgress = chosen.onProgress;
    hooks.onSums = [&](const SharedPasses& soFar, double seconds, bool isLast) {
        keep(chosen, soFar, seconds, isLast);
    };
    hooks.onGap = [this](const std::vector<PassRange>& there) {
        keeper_.missed(fmt::format("passes {} are there, others before them are missing", text(there)));
    };
    hooks.onDropped = [this](const std::string& name, const std::string& why) {
        warn_(fmt::format("{} is dropped, others render its passes: {}", name, why));
    };
    hooks.secondsToNextSums = [this] { return keeper_.secondsToNext(); };
    return hooks;
}

void PassSharing::keep(const ChosenRender& chosen, const SharedPasses& soFar, double seconds, bool isLast) {
    const auto save = [&](StateSink& sink) {
        saveLearned(sink, *chosen.renderer->learned());
        soFar.sums.save(sink, "film");
        soFar.radii.copyTo(sink);
    };
    keeper_.afterPasses(
        chosen.soFar,
        {report_, soFar.sums.counters, soFar.sums.shape, soFar.passes.end, [&] { return soFar.sums.timings; }, save},
        seconds, isLast);
}

void PassSharing::describe(AutoRender& render) const {
    render.workers = records_;
    render.timings = timings_;
}

std::shared_ptr<Device> livingDevice(const RenderOptions& options, const SharedDevices& devices,
                                     const AutoRender& render) {
    for (const DeviceChoice& choice : devices.choices) {
        const bool isLost = std::any_of(render.workers.begin(), render.workers.end(), [&](const WorkerRecord& one) {
            return one.name == text(choice) && !one.failure.empty();
        });
        if (isLost) continue;
        return choice == devices.choices.front() ? devices.first : openDevice(options, choice);
    }
    return devices.first;
}

void assistJob(const RenderOptions& options) {
    // While rank 0 learns; what is wrong with it is said when it is needed.
    std::shared_ptr<const Scene> early;
    if (options.sensor != "all") failureOf([&] { early = loadRenderScene(options).scene; });
    const OpenWorkers open = [&](const RankPlan& plan) -> std::unique_ptr<PassWorkers> {
        RenderOptions here = options;
        here.sensor = plan.sensor;
        const auto scene = early && plan.sensor == options.sensor ? early : loadRenderScene(here).scene;
        const RendererPlan ofRenderers{scene, plan.settings,
                                       std::make_shared<LearnedScene>(restoreLearned(plan.learned)), plan.checksums};
        auto workers = std::make_unique<DeviceWorkers>(answerSeconds(options));
        addDevices(*workers, here, ownDevices(here), ofRenderers);
        return workers;
    };
    // Signals are for rank 0, which ends the job; a second one ends this rank at once.
    Job::current().assist(open, [] { catchInterrupt(); });
}

} // namespace quasilux
