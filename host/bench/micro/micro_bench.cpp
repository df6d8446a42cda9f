#include "bench/micro/micro_bench.h"

#include "bench/micro/micro_parts.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace quasilux {

namespace {

struct NamedPart {
    std::string name;
    void (*bench)(const MicroRun&);
};

const std::vector<NamedPart>& allParts() {
    static const std::vector<NamedPart> parts{{"traversal", benchTraversal},
                                              {"map", benchMap},
                                              {"gather", benchGather},
                                              {"samplers", benchSamplers},
                                              {"tree", benchTree}};
    return parts;
}

/// One thread, then all; of a device that is no CPU, the whole of it.
std::vector<unsigned> threadCounts(const DeviceInfo& device) {
    if (!device.isCpu) return {0};
    return device.computeUnits > 1 ? std::vector{1u, device.computeUnits} : std::vector{1u};
}

} // namespace

const std::vector<std::string>& microParts() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const NamedPart& part : allParts()) list.push_back(part.name);
        return list;
    }();
    return names;
}

std::vector<std::string> parseMicroParts(const std::string& text) {
    if (text.empty() || text == "all") return microParts();
    std::vector<std::string> parts;
    std::istringstream list(text);
    for (std::string name; std::getline(list, name, ',');) {
        const auto& known = microParts();
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(
                fmt::format("--micro: no part '{}', expected all or some of {} between commas (scene files go "
                            "before --micro)",
                            name, fmt::join(known, ", ")));
        parts.push_back(name);
    }
    return parts;
}

MicroReport runMicro(const MicroSettings& settings, const MicroProgress& progress,
                     const std::atomic<bool>& interrupted) {
    MicroReport report;
    report.device = Device(settings.device).info();
    const MicroRun run{settings, report, progress, interrupted, threadCounts(report.device)};
    for (const NamedPart& part : allParts())
        if (!interrupted && std::count(settings.parts.begin(), settings.parts.end(), part.name) > 0) part.bench(run);
    return report;
}

} // namespace quasilux
