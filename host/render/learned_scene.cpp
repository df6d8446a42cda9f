#include "render/learned_scene.h"

#include "render/method.h"
#include "render/pass_params.h"
#include "render/photon_forecast.h"
#include "render/regions.h"

#include <algorithm>

namespace quasilux {

namespace {

constexpr unsigned samplesOfPixel = 8, mostSamplesOfPath = 4; // of many emitters, in a pass
// Of a round while learning.
constexpr unsigned fewestPhotonsOfRound = 8192, mostPhotonsOfRound = 131072;
constexpr unsigned firstRoundPass = forecastPass - 16; // no render gets there

RoundResult sumOfRegions(const std::vector<shared::RegionCount>& regions, unsigned photons) {
    RoundResult result;
    double arrivals = 0, seen = 0;
    for (const auto& region : regions) {
        arrivals += region.arrivals;
        seen += region.seenArrivals;
        for (unsigned c = 0; c < LIGHT_CLASSES; ++c) result.density[c] += double(region.density[c]) / photons;
        for (unsigned o = 0; o < DISTANCE_OCTAVES; ++o)
            result.densityByOctave[o] += double(region.densityByOctave[o]) / photons;
    }
    if (arrivals > 0) result.seenShare = seen / arrivals;
    return result;
}

RoundResult tracePhotonRound(Device& device, const Program& program, const GeometryBuffers& geometry,
                             shared::PhotonParams params, unsigned round) {
    params.paths = std::clamp(2 * params.paths, fewestPhotonsOfRound, mostPhotonsOfRound);
    params.pathsPerRegion = photonsPerRegion(device.info());
    params.regions = regionsOf(params.paths, params.pathsPerRegion);
    params.pass = firstRoundPass + round;
    params.learns = 1;
    std::fill(std::begin(params.keepProbability), std::end(params.keepProbability), 1.f);
    const Buffer<shared::PhotonRecord> records(device, params.paths, "learned photons");
    const Buffer<uint32_t> blocks(device, 1, "photon blocks");
    const Buffer<shared::RegionCount> regions(device, params.regions, "photon regions");
    program.kernel("tracePhotons")
        .launchLong(params.regions, geometry.nodes, geometry.blocks, geometry.tables, records, blocks, regions, params);
    RoundResult result = sumOfRegions(regions.read(), params.paths);
    result.photons = records.read();
    return result;
}

} // namespace

LearnedScene learnScene(Device& device, const Program& program, const Scene& scene, const RenderSettings& settings,
                        DeviceScene& flat, GeometryBuffers& geometry) {
    if (!learns(flat.features, settings)) return {};
    Learning learning(device, program, flat, SceneBuffers{geometry.nodes, geometry.blocks, geometry.tables},
                      cameraParams(flat, settings, maxDepthOf(scene)));
    learning.followImportance(mayTakeDirectFromPhotons(flat.features, settings));
    // Rounds know photons by what camera paths gather, not by what a meter counts itself.
    if (settings.map == MapOrder::photons && !meterCountsPhotons(flat.features, settings))
        learning.traceRounds([&](unsigned round) {
            return tracePhotonRound(device, program, geometry, photonParams(scene, flat, settings), round);
        });
    return learning.learned();
}

// A path without photons costs little more than its samples: another path is worth more than another sample of this one.
unsigned directSamplesOf(const LearnedScene& learned, unsigned classes, unsigned cameraPaths) {
    if (learned.tables.lights.empty() || classes == 0) return 1;
    return std::clamp(samplesOfPixel / cameraPaths, 1u, mostSamplesOfPath);
}

} // namespace quasilux
