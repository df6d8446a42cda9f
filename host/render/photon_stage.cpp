#include "render/photon_stage.h"

#include "render/pass_params.h"
#include "render/regions.h"

#include <algorithm>

namespace quasilux {

namespace {

PlannedBuffer<shared::RegionCount> regionCounts(unsigned regions) { return {"photon regions", regions}; }

} // namespace

PhotonStage::PhotonStage(Device& device, const Program& pass, const GeometryBuffers& geometry,
                         shared::PhotonParams params, unsigned classes, bool storesDepth,
                         std::optional<uint64_t> photons)
    : geometry_(geometry), tracePhotons_(pass.kernel("tracePhotons")), photons_(device, pass, classes, storesDepth),
      params_(params), seed_(uint64_t{params.seedHigh} << 32 | params.seedLow), classes_(classes) {
    params_.pathsPerRegion = photonsPerRegion(device.info());
    params_.regions = regionsOf(params_.paths, params_.pathsPerRegion);
    regions_ = regionCounts(params_.regions).make(device);
    photons_.make(classes == 0 ? 0 : photons.value_or(params_.paths), params_.regions);
    shared::MapParams& map = photons_.table().map();
    map.media = params_.scene.media;
    map.fluxUnit = 1 / params_.perFluxUnit;
    thinVolume({1, 1, 1, 1});
}

BufferSizes PhotonStage::plan(unsigned paths, uint64_t photons, unsigned classes, bool storesDepth,
                              const DeviceInfo& device) {
    const unsigned regions = regionsOf(paths, photonsPerRegion(device));
    BufferSizes sizes = PhotonArrays::plan(classes, photons, regions, storesDepth, device);
    sizes.merge(sizesOf(regionCounts(regions)));
    return sizes;
}

std::vector<shared::RegionCount> PhotonStage::trace() {
    for (;;) {
        photons_.clear();
        params_.photonBlocks = photons_.blockCount();
        params_.photonStride = photons_.table().map().photonStride;
        if (meter_) {
            meter_->sums.fill(0);
            tracePhotons_.launchLong(params_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables,
                                     photons_.arrays(), photons_.blocks(), regions_, params_, meter_->sums,
                                     meter_->quantaPerRadiance);
        } else {
            tracePhotons_.launchLong(params_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables,
                                     photons_.arrays(), photons_.blocks(), regions_, params_);
        }
        auto counts = regions_.read();
        if (!photons_.enlarge(counts)) return counts;
    }
}

void PhotonStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability) {
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
        params_.keepProbability[c] = keepProbability[c];
        photons_.table().map().perKept[c] = 1 / keepProbability[c];
    }
}

PhotonPassCount PhotonStage::run(unsigned pass, PassPart part, const std::array<float, LIGHT_CLASSES>& radius,
                                 float volumeScale) {
    shared::MapParams& map = photons_.table().map();
    std::copy(radius.begin(), radius.end(), map.radius);
    map.volumeScale = volumeScale;
    setNumbers(params_, seed_, pass, part);
    PhotonPassCount total;
    if (classes_ == 0) return total;
    const auto counts = trace();
    for (const auto& count : counts) total.add(count);
    photons_.sort(regions_, counts, geometry_);
    total.stored = photons_.table().countBySlot();
    return total;
}

} // namespace quasilux
