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

uint64_t addBySlot(std::map<std::string, uint64_t>& total, const std::array<uint64_t, PHOTON_SLOTS>& ofPass) {
    uint64_t sum = 0;
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (ofPass[slot] > 0) total[slotName(slot)] += ofPass[slot];
        sum += ofPass[slot];
    }
    return sum;
}

} // namespace quasilux
