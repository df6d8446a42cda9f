#include "render/render_counters.h"

#include "render/scene_report.h"

namespace quasilux {

void RenderCounters::addTraced(const TraceCount& ofPass, bool countsMeterCaustics, bool countsEnergy) {
    cutPaths += ofPass.cutPaths;
    nonFinite += ofPass.nonFinite;
    overflows += ofPass.overflows;
    clipped += ofPass.clipped;
    fluxCut += ofPass.fluxCut;
    if (countsMeterCaustics) meterCaustics = meterCaustics.value_or(0) + ofPass.meterCaustics;
    if (!countsEnergy) return;
    if (!energy) energy.emplace();
    *energy += ofPass.energy;
}

void RenderCounters::noteMapSize(uint64_t points, uint64_t bytes) {
    storedPoints = std::max(storedPoints, points);
    storedBytes = std::max(storedBytes, bytes);
}

void addCounts(RenderCounters& all, const RenderCounters& part) {
    const auto addMap = [](auto& to, const auto& from) {
        for (const auto& [key, value] : from) to[key] += value;
    };
    all.passes += part.passes;
    all.photonsEmitted += part.photonsEmitted;
    addMap(all.photonsStored, part.photonsStored);
    addMap(all.cameraPointsStored, part.cameraPointsStored);
    all.noteMapSize(part.storedPoints, part.storedBytes);
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

uint64_t addBySlot(std::map<std::string, uint64_t>& total, const std::array<uint64_t, PHOTON_SLOTS>& ofPass) {
    uint64_t sum = 0;
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (ofPass[slot] > 0) total[slotName(slot)] += ofPass[slot];
        sum += ofPass[slot];
    }
    return sum;
}

} // namespace quasilux
