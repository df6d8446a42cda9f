#include "support/stored_photons.h"

#include "bench/micro/native_flux.h"
#include "bench/micro/native_grid.h"
#include "render/flux_unit.h"
#include "render/method.h"
#include "render/pass_program.h"
#include "render/photon_stage.h"
#include "scene/color.h"
#include "support/test_kernels.h"

#include <bit>

namespace quasilux {

namespace {

/// Photon `photon` of the sorted arrays, which is of this slot.
StoredPhoton read(const std::vector<uint32_t>& sorted, const shared::MapParams& map, size_t photon, unsigned slot) {
    const auto field = [&](size_t number) { return sorted[number * map.photonStride + photon]; };
    const auto coordinate = [&](size_t number) { return std::bit_cast<float>(field(number)); };
    const shared::Rgb flux = nativeUnpackFlux(field(fieldFlux));
    const float unit = map.fluxUnit * (slot < LIGHT_CLASSES ? 1 : map.perKept[slot - LIGHT_CLASSES]);
    return {coordinate(fieldX), coordinate(fieldY), coordinate(fieldZ), {unit * flux.r, unit * flux.g, unit * flux.b}};
}

} // namespace

StoredPasses tracePhotons(const DeviceScene& flat, const RenderSettings& settings, const PhotonTracing& tracing) {
    const GeometryBuffers geometry(testDevice(), flat);
    shared::PhotonParams params{};
    params.seedLow = tracing.seed;
    params.paths = tracing.paths;
    params.perFluxUnit = 1 / fluxUnit(flat, params.paths);
    params.maxDepth = QL_NONE;
    params.scene = flat.offsets;
    const Program program =
        passProgram(testDevice(), MapOrder::photons, flat, settings, tracing.options, tracing.replaced);
    PhotonStage stage(testDevice(), program, geometry, params, photonClasses(flat.features, settings), false);
    stage.thinVolume(tracing.keep);
    StoredPasses stored(tracing.passes);
    for (unsigned pass = 0; pass < tracing.passes; ++pass) {
        std::array<float, LIGHT_CLASSES> radius;
        radius.fill(tracing.radius);
        const auto count = stage.run(pass, {}, radius, 1);
        const auto sorted = stage.sorted().read();
        size_t photon = 0;
        for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot)
            for (uint64_t k = 0; k < count.stored[slot]; ++k)
                stored[pass][slot].push_back(read(sorted, stage.table().map(), photon++, slot));
    }
    return stored;
}

MeanAndError directShareOfFlux(const DeviceScene& flat, const RenderSettings& settings) {
    PhotonTracing tracing;
    tracing.paths = 50'000;
    tracing.radius = 0.1f;
    std::vector<double> flux;
    for (const auto& pass : tracePhotons(flat, settings, tracing)) {
        flux.push_back(0);
        for (const StoredPhoton& photon : pass[LIGHT_DIRECT]) flux.back() += mean(photon.flux) / flat.emittedFlux;
    }
    return meanAndError(flux);
}

} // namespace quasilux
