#include "cli/bench_parts.h"

#include "bench/parts/device_comparison.h"
#include "bench/parts/growth.h"
#include "bench/parts/kernel_comparison.h"
#include "bench/parts/thread_scaling.h"
#include "cli/interrupt.h"
#include "output/progress_line.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double shareOfTime = 0.1; // of --time, for each size and each round: there are many of them

bool isAskedFor(const BenchOptions& options, const std::string& subject) {
    return std::find(options.growth.begin(), options.growth.end(), subject) != options.growth.end();
}

class Parts {
public:
    Parts(const BenchOptions& options, const std::vector<Scene>& scenes, const std::vector<int>& devices,
          Attempts& attempts)
        : options_(options), devices_(devices), attempts_(attempts), line_(stderr, !options.quiet) {
        for (size_t k = 0; k < scenes.size(); ++k)
            scenes_.push_back({options.scenes[k], options.definitions, &scenes[k]});
    }

    BenchSection passTimes() {
        BenchSection section{"passTimes", "Pass", nlohmann::json::array(), {}};
        std::vector<TableRow> rows{{"scene", "device", "CPU ms", "ms", "kernels, ms"}};
        forEach("a pass", [&](const PartScene& scene, size_t place) {
            const auto measured =
                measurePass(devices_[place], *scene.scene, settingsFromScene(*scene.scene), options_.seconds);
            std::string kernels;
            for (const auto& [kernel, seconds] : measured.least.kernels)
                kernels += fmt::format("{}{} {:.2f}", kernels.empty() ? "" : ", ", kernel, 1e3 * seconds);
            rows.push_back({scene.path, std::to_string(place), fmt::format("{:.2f}", 1e3 * measured.least.cpu),
                            fmt::format("{:.2f}", 1e3 * measured.least.clock), kernels});
            nlohmann::json entry = passMeasurementJson(measured);
            entry["scene"] = scene.path;
            entry["device"] = place;
            section.figures.push_back(entry);
        });
        section.tables.push_back({"the least of all passes", "", rows, ""});
        return section;
    }

    BenchSection growth() {
        std::vector<GrowthSeries> all;
        for (const std::string& subject : growthSubjects())
            for (size_t place = 0; place < devices_.size(); ++place) {
                if (!isAskedFor(options_, subject)) continue;
                const auto onSize = [&](double size) { say(fmt::format("growth, {} {:g}", subject, size)); };
                attempts_.run(fmt::format("growth of {}, device {}", subject, place), [&] {
                    all.push_back(measureGrowth(subject, devices_[place], options_.growthSteps,
                                                shareOfTime * options_.seconds, onSize, interruptFlag()));
                    all.back().device = place;
                });
            }
        return growthSection(all);
    }

    BenchSection threads() {
        std::vector<ThreadScaling> all;
        forEach("threads", [&](const PartScene& scene, size_t place) {
            all.push_back(measureThreads(
                scene, devices_[place], shareOfTime * options_.seconds, [&](const std::string& step) { say(step); },
                interruptFlag()));
            all.back().device = place;
        });
        return threadSection(all);
    }

    BenchSection devices() {
        std::vector<DeviceResult> all;
        for (const PartScene& scene : scenes_)
            attempts_.run("comparison of devices: " + scene.path, [&] {
                const auto results = compareDevices(scene, devices_, shareOfTime * options_.seconds,
                                                    [&](const std::string& step) { say(step); });
                all.insert(all.end(), results.begin(), results.end());
            });
        return deviceSection(all);
    }

    BenchSection kernels() {
        std::vector<KernelComparison> all;
        forEach("kernels for the scene and generic", [&](const PartScene& scene, size_t place) {
            all.push_back(compareKernels(scene, devices_[place], options_.seconds, interruptFlag()));
            all.back().device = place;
        });
        return kernelSection(all);
    }

private:
    void say(const std::string& step) {
        catchInterrupt();
        Progress progress;
        progress.phase = step;
        line_.update(progress);
    }

    template <typename Measure>
    void forEach(const std::string& what, const Measure& measure) {
        for (const PartScene& scene : scenes_)
            for (size_t place = 0; place < devices_.size(); ++place) {
                const std::string step = fmt::format("{}: {}, device {}", what, scene.path, place);
                attempts_.run(step, [&] {
                    say(step);
                    measure(scene, place);
                });
            }
    }

    const BenchOptions& options_;
    std::vector<PartScene> scenes_;
    const std::vector<int>& devices_;
    Attempts& attempts_;
    ProgressLine line_;
};

} // namespace

void checkParts(const BenchOptions& options) {
    const bool someMade = options.micro || !options.growth.empty();
    const bool onlyMade = options.methods.empty() && someMade && !isAskedFor(options, "threads") &&
                          !options.compareDevices && !options.compareKernels && !options.passTimes;
    if (options.scenes.empty() && !onlyMade)
        throw InputError("no SCENE is given, expected at least one; only --micro, and --growth of triangles, photons, "
                         "pixels and bdd, "
                         "without --method, need none");
}

void runParts(const BenchOptions& options, const std::vector<Scene>& scenes, const std::vector<int>& devices,
              Attempts& attempts, std::vector<BenchSection>& sections) {
    if (!options.hasParts()) return;
    Parts parts(options, scenes, devices, attempts);
    const bool growsOnItsOwn = std::any_of(options.growth.begin(), options.growth.end(),
                                           [](const std::string& subject) { return subject != "threads"; });
    const auto add = [&](bool isWanted, BenchSection (Parts::*measure)()) {
        if (!isWanted) return;
        BenchSection section = (parts.*measure)();
        if (!section.figures.empty()) sections.push_back(std::move(section));
    };
    add(options.passTimes, &Parts::passTimes);
    add(growsOnItsOwn, &Parts::growth);
    add(isAskedFor(options, "threads"), &Parts::threads);
    add(options.compareDevices, &Parts::devices);
    add(options.compareKernels, &Parts::kernels);
}

} // namespace quasilux
