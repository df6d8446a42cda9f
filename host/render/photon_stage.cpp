#include "render/photon_stage.h"

#include <algorithm>

namespace quasilux {

PhotonStage::PhotonStage(Device& device, const Program& pass, const GeometryBuffers& geometry,
                         shared::PhotonParams params, unsigned classes, bool storesDepth, const PhotonRoom& room)
    : device_(device), geometry_(geometry), tracePhotons_(pass.kernel("tracePhotons")),
      index_(device, pass, classes, mapFields(storesDepth), "photon"), params_(params), classes_(classes) {
    params_.pathsPerRegion = pathsPerRegion;
    params_.regions = regionCount(params_.paths);
    std::fill_n(params_.keepProbability, LIGHT_CLASSES, 1.f);
    makeRegions(room.ofRegion ? room.ofRegion : pathsPerRegion);
    regions_ = Buffer<shared::RegionCount>(device, params_.regions, "photon regions");
    index_.map().media = params_.scene.media;
    index_.makeTable(room.inMap ? room.inMap : params_.paths, params_.regions);
}

std::vector<shared::RegionCount> PhotonStage::trace() {
    for (;;) {
        if (meter_) {
            meter_->sums.fill(0);
            tracePhotons_.launchLong(params_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, photons_,
                                     regions_, params_, meter_->sums, meter_->quantaPerRadiance);
        } else {
            tracePhotons_.launchLong(params_.regions, geometry_.nodes, geometry_.blocks, geometry_.tables, photons_,
                                     regions_, params_);
        }
        auto counts = regions_.read();
        unsigned wanted = 0;
        for (const auto& count : counts) wanted = std::max(wanted, count.wanted);
        if (wanted <= params_.regionCapacity) return counts;
        makeRegions(wanted + wanted / 4);
    }
}

void PhotonStage::makeRegions(unsigned capacity) {
    if (capacity == params_.regionCapacity) return;
    params_.regionCapacity = capacity;
    photons_ = Buffer<shared::Photon>();
    photons_ = Buffer<shared::Photon>(device_, size_t(params_.regions) * capacity, "photons as traced");
}

void PhotonStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability) {
    std::copy(keepProbability.begin(), keepProbability.end(), params_.keepProbability);
}

PhotonPassCount PhotonStage::run(unsigned pass, const std::array<float, LIGHT_CLASSES>& radius, float volumeScale) {
    std::copy(radius.begin(), radius.end(), index_.map().radius);
    index_.map().volumeScale = volumeScale;
    params_.pass = pass;
    PhotonPassCount total;
    if (classes_ == 0) return total;
    uint64_t stored = 0;
    for (const auto& count : trace()) {
        stored += count.stored;
        total.fullestRegion = std::max(total.fullestRegion, count.stored);
        total.add(count);
    }
    index_.map().regionCapacity = params_.regionCapacity;
    index_.sort(photons_, regions_, geometry_, stored);
    total.stored = index_.countBySlot();
    return total;
}

} // namespace quasilux
