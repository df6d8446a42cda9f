#include "render/counter_sums.h"

#include <algorithm>

namespace quasilux {

void addCounts(RenderCounters& all, const RenderCounters& part) {
    const auto addMap = [](auto& to, const auto& from) {
        for (const auto& [key, value] : from) to[key] += value;
    };
    all.passes += part.passes;
    all.photonsEmitted += part.photonsEmitted;
    addMap(all.photonsStored, part.photonsStored);
    addMap(all.cameraPointsStored, part.cameraPointsStored);
    all.storedPoints = std::max(all.storedPoints, part.storedPoints);
    all.storedBytes = std::max(all.storedBytes, part.storedBytes);
    all.cameraPaths += part.cameraPaths;
    all.nonFinite += part.nonFinite;
    all.cutPaths += part.cutPaths;
    all.overflows += part.overflows;
    all.clipped += part.clipped;
    if (part.meterCaustics) all.meterCaustics = all.meterCaustics.value_or(0) + *part.meterCaustics;
    all.fluxEmitted += part.fluxEmitted;
    all.fluxCut += part.fluxCut;
    if (part.energy) *(all.energy ? &*all.energy : &all.energy.emplace()) += *part.energy;
    all.throughputCut += part.throughputCut;
    all.prepareSeconds += part.prepareSeconds;
    all.compileSeconds += part.compileSeconds;
    all.renderSeconds += part.renderSeconds;
    all.radiusSeconds += part.radiusSeconds;
    all.radiusPaths += part.radiusPaths;
}

void addTimings(std::map<std::string, KernelTiming>& all, const std::map<std::string, KernelTiming>& part) {
    for (const auto& [kernel, timing] : part) {
        KernelTiming& sum = all[kernel];
        sum.launches += timing.launches;
        sum.seconds += timing.seconds;
        sum.privateBytes = timing.privateBytes;
    }
}

} // namespace quasilux
