#include "render/photon_stage.h"

#include <algorithm>

namespace quasilux {

namespace {

constexpr unsigned pathsPerRegion = 256;

} // namespace

PhotonStage::PhotonStage(Device& device, const std::string& options, const GeometryBuffers& geometry,
                         shared::PhotonParams params, unsigned classes, bool storesDepth)
    : device_(device), geometry_(geometry), tracing_(device, "photon_trace.cl", options),
      tracePhotons_(tracing_.kernel("tracePhotons")),
      index_(device, "photon_map.cl", options, classes, storesDepth ? 9 : 8, "photon"), params_(params),
      classes_(classes) {
    params_.pathsPerRegion = pathsPerRegion;
    params_.regions = (params_.paths + pathsPerRegion - 1) / pathsPerRegion;
    std::fill_n(params_.keepProbability, LIGHT_CLASSES, 1.f);
    makeRegions(pathsPerRegion);
    regions_ = Buffer<shared::RegionCount>(device, params_.regions, "photon regions");
    index_.map().media = params_.scene.media;
    index_.makeTable(params_.paths, params_.regions);
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

void PhotonStage::thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability, double expectedPhotons) {
    std::copy(keepProbability.begin(), keepProbability.end(), params_.keepProbability);
    makeRegions(std::max(pathsPerRegion, static_cast<unsigned>(1.5 * expectedPhotons / params_.regions)));
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
        total.add(count);
    }
    index_.map().regionCapacity = params_.regionCapacity;
    index_.sort(photons_, regions_, geometry_, stored);
    total.stored = index_.countBySlot();
    return total;
}

} // namespace quasilux
