// What a render counts over its passes.
#pragma once

#include "render/trace_count.h"

#include <array>
#include <map>
#include <optional>
#include <string>

namespace quasilux {

/// Counted over all passes.
struct RenderCounters {
    uint64_t passes = 0;
    uint64_t photonsEmitted = 0;
    std::map<std::string, uint64_t> photonsStored;      ///< by class; in media "volume " and the class
    std::map<std::string, uint64_t> cameraPointsStored; ///< the same for the camera map
    uint64_t storedPoints = 0; ///< photons or camera points in the map of one pass, the most of all passes
    uint64_t storedBytes = 0;  ///< that they take, traced and in the index
    uint64_t cameraPaths = 0;
    uint64_t nonFinite = 0; ///< samples dropped since they were not finite; a right render has none
    uint64_t cutPaths = 0;  ///< paths ended by the hard limit on events
    uint64_t overflows = 0; ///< sums of splats that left their range (camera map); a right render has none
    uint64_t clipped = 0;   ///< photons with more flux than can be stored, which is cut to that
    std::optional<uint64_t>
        meterCaustics;                   ///< photons of caustics that an irradiance meter has met; where it counts any
    double fluxEmitted = 0, fluxCut = 0; ///< W, mean of R, G, B
    std::optional<EnergyBalance> energy; ///< where RenderSettings::energyBalance asks for it
    double throughputCut = 0;            ///< of camera paths, mean of R, G, B; each begins with 1
    double prepareSeconds = 0, compileSeconds = 0, firstPassSeconds = 0, renderSeconds = 0;
    double radiusSeconds = 0; ///< of renderSeconds, for choosing radii by pixel in the first passes, and
    uint64_t radiusPaths = 0; ///< camera paths for it, at the largest radius

    /// What a pass traced; caustics at meters and energy where the render counts them.
    void addTraced(const TraceCount& ofPass, bool countsMeterCaustics, bool countsEnergy);
    /// The map of a pass had so many photons or camera points, which took so many bytes.
    void noteMapSize(uint64_t points, uint64_t bytes);
};

/// Of other passes; firstPassSeconds stay those of `all`.
void addCounts(RenderCounters& all, const RenderCounters& part);

/// Adds to photonsStored or cameraPointsStored what a pass stored, by slot of its map. Returns the sum.
uint64_t addBySlot(std::map<std::string, uint64_t>& total, const std::array<uint64_t, PHOTON_SLOTS>& ofPass);

} // namespace quasilux
