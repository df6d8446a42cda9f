#include "bench/parts/kernel_comparison.h"

#include <fmt/format.h>
#include <set>

namespace quasilux {

using nlohmann::json;

namespace {

constexpr size_t fewestPairs = 4;
constexpr double comparedShare = 0.02; // of a pass: the ratio of less says little

/// One side of the comparison.
struct Side {
    TimedRenderer timed;
    std::vector<PassTimes> passes;

    Side(int device, const Scene& scene, bool generic) : timed(device, scene, settingsOf(scene, generic)) {
        timed.pass(0); // compiles, with some runtimes
    }
    static RenderSettings settingsOf(const Scene& scene, bool generic) {
        RenderSettings settings = settingsFromScene(scene);
        settings.genericKernels = generic;
        return settings;
    }
    PassMeasurement result() {
        PassMeasurement measured = measurementOf(timed);
        measured.least = leastOf(passes);
        return measured;
    }
};

json ratioJson(const PairedRatio& ratio) { return {{"ratio", ratio.ratio}, {"standardError", ratio.standardError}}; }

std::string ratioText(const PairedRatio& ratio) {
    return fmt::format("{:.2f} +- {:.2f}", ratio.ratio, ratio.standardError);
}

std::map<std::string, PairedRatio> kernelRatios(const Side& specialised, const Side& generic, bool isCpu) {
    std::map<std::string, std::vector<double>> ratios;
    for (size_t k = 0; k < specialised.passes.size(); ++k)
        for (const auto& [kernel, seconds] : specialised.passes[k].kernelCosts) {
            const auto other = generic.passes[k].kernelCosts.find(kernel);
            if (other == generic.passes[k].kernelCosts.end() ||
                seconds < comparedShare * specialised.passes[k].cost(isCpu))
                continue;
            ratios[kernel].push_back(other->second / seconds);
        }
    std::map<std::string, PairedRatio> medians;
    for (const auto& [kernel, values] : ratios) medians[kernel] = medianRatio(values);
    return medians;
}

} // namespace

KernelComparison compareKernels(const PartScene& scene, int device, double seconds,
                                const std::atomic<bool>& interrupted) {
    Side specialised(device, *scene.scene, false), generic(device, *scene.scene, true);
    KernelComparison result;
    result.scene = scene.path;
    result.isCpu = specialised.timed.device().info().isCpu;
    std::vector<double> ratios;
    for (double spent = 0; ratios.size() < fewestPairs || (spent < seconds && !interrupted);) {
        const auto number = static_cast<unsigned>(ratios.size());
        specialised.passes.push_back(specialised.timed.pass(number));
        generic.passes.push_back(generic.timed.pass(number));
        const PassTimes &one = specialised.passes.back(), &other = generic.passes.back();
        ratios.push_back(other.cost(result.isCpu) / one.cost(result.isCpu));
        spent += one.clock + other.clock;
    }
    result.pairs = ratios.size();
    result.pass = medianRatio(ratios);
    result.kernels = kernelRatios(specialised, generic, result.isCpu);
    result.specialised = specialised.result();
    result.generic = generic.result();
    return result;
}

BenchSection kernelSection(const std::vector<KernelComparison>& all) {
    BenchSection section{"kernels", "Kernels for the scene against generic ones", json::array(), {}};
    std::set<std::string> names;
    for (const auto& one : all)
        for (const auto& [kernel, ratio] : one.kernels) names.insert(kernel);
    TableRow headings{"scene", "device", "pairs", "pass"};
    headings.insert(headings.end(), names.begin(), names.end());
    std::vector<TableRow> rows{headings};
    for (const auto& one : all) {
        json kernels = json::object();
        TableRow row{one.scene, std::to_string(one.device), std::to_string(one.pairs), ratioText(one.pass)};
        for (const std::string& name : names) {
            const auto found = one.kernels.find(name);
            row.push_back(found == one.kernels.end() ? "" : ratioText(found->second));
            if (found != one.kernels.end()) kernels[name] = ratioJson(found->second);
        }
        rows.push_back(row);
        section.figures.push_back({{"scene", one.scene},
                                   {"device", one.device},
                                   {"pairs", one.pairs},
                                   {"genericOverScene", {{"pass", ratioJson(one.pass)}, {"kernels", kernels}}},
                                   {"scenePass", passMeasurementJson(one.specialised)},
                                   {"genericPass", passMeasurementJson(one.generic)}});
    }
    section.tables.push_back(
        {"generic over specialised, median of pairs", "", rows,
         "Above 1 specialised kernels are faster. Pass: CPU seconds of a CPU device, else those on the "
         "clock; kernels by their shares of it. Passes of both by turns."});
    return section;
}

} // namespace quasilux
