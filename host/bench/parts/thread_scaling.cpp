#include "bench/parts/thread_scaling.h"

#include <fmt/format.h>
#include <set>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr unsigned rounds = 5;

/// PoCL's variable, and that of Intel's runtime.
std::vector<std::pair<std::string, std::string>> environmentOf(unsigned threads) {
    const std::string text = std::to_string(threads);
    return {{"POCL_MAX_PTHREAD_COUNT", text}, {"DPCPP_CPU_NUM_CUS", text}};
}

std::map<std::string, double> speedUps(const PassTimes& one, const PassTimes& many) {
    std::map<std::string, double> result{{"pass", one.clock / many.clock}};
    for (const auto& [kernel, seconds] : one.kernels)
        if (const auto found = many.kernels.find(kernel); found != many.kernels.end())
            result[kernel] = seconds / found->second;
    return result;
}

/// CPUs at work: fewer than the threads where these wait for each other, or for other programs.
double processorsUsed(const PassTimes& pass) { return pass.cpu / pass.clock; }

void summarise(ThreadScaling& scaling, const std::vector<std::vector<PassMeasurement>>& measured) {
    for (size_t t = 0; t < measured.size(); ++t) {
        std::vector<PassTimes> passes;
        std::vector<double> ratios;
        for (size_t round = 0; round < measured[t].size(); ++round) {
            passes.push_back(measured[t][round].least);
            ratios.push_back(measured[0][round].least.clock / measured[t][round].least.clock);
        }
        scaling.least.push_back(measured[t].front());
        scaling.least.back().least = leastOf(passes);
        scaling.speedUp.push_back(speedUps(scaling.least.front().least, scaling.least.back().least));
        scaling.rounds.push_back(medianRatio(ratios));
    }
}

} // namespace

ThreadScaling measureThreads(const PartScene& scene, int device, double seconds, const OnStep& onStep,
                             const std::atomic<bool>& interrupted) {
    ThreadScaling scaling;
    scaling.scene = scene.path;
    const DeviceInfo info = Device(device).info();
    if (!info.isCpu) return scaling;
    for (unsigned threads = 1; threads <= info.computeUnits; threads *= 2) scaling.threads.push_back(threads);
    std::vector<std::vector<PassMeasurement>> measured(scaling.threads.size());
    for (unsigned round = 0; round < rounds && !interrupted; ++round)
        for (size_t t = 0; t < scaling.threads.size(); ++t) {
            onStep(fmt::format("{}, {} threads, round {} of {}", scene.path, scaling.threads[t], round + 1, rounds));
            measured[t].push_back(measureInChild(scene, device, seconds, environmentOf(scaling.threads[t])));
        }
    if (measured.front().empty())
        scaling.threads.clear();
    else
        summarise(scaling, measured);
    return scaling;
}

BenchSection threadSection(const std::vector<ThreadScaling>& all) {
    BenchSection section{"threads", "Threads", json::array(), {}};
    std::set<std::string> kernels;
    for (const auto& one : all)
        for (const auto& speedUp : one.speedUp)
            for (const auto& [name, factor] : speedUp)
                if (name != "pass") kernels.insert(name);
    TableRow headings{"scene", "device", "threads", "ms a pass", "CPUs used", "speed-up", "of rounds"};
    headings.insert(headings.end(), kernels.begin(), kernels.end());
    std::vector<TableRow> rows{headings};
    for (const auto& one : all) {
        json points = json::array();
        for (size_t t = 0; t < one.threads.size(); ++t) {
            const PassTimes& least = one.least[t].least;
            const auto& speedUp = one.speedUp[t];
            TableRow row{one.scene,
                         std::to_string(one.device),
                         std::to_string(one.threads[t]),
                         fmt::format("{:.1f}", 1e3 * least.clock),
                         fmt::format("{:.2f}", processorsUsed(least)),
                         fmt::format("{:.2f}", speedUp.at("pass")),
                         fmt::format("{:.2f} +- {:.2f}", one.rounds[t].ratio, one.rounds[t].standardError)};
            for (const std::string& kernel : kernels) {
                const auto found = speedUp.find(kernel);
                row.push_back(found == speedUp.end() ? "" : fmt::format("{:.2f}", found->second));
            }
            rows.push_back(row);
            points.push_back(
                {{"threads", one.threads[t]},
                 {"pass", passMeasurementJson(one.least[t])},
                 {"speedUp", speedUp},
                 {"rounds", {{"ratio", one.rounds[t].ratio}, {"standardError", one.rounds[t].standardError}}}});
        }
        section.figures.push_back({{"scene", one.scene}, {"device", one.device}, {"points", points}});
    }
    section.tables.push_back(
        {"speed-up over one thread", "", rows,
         fmt::format("On the clock, the least of all passes of {} rounds by turns; of rounds: median of each "
                     "round's own. Where fewer CPUs were used than threads, other programs ran too.",
                     rounds)});
    return section;
}

} // namespace quasilux
