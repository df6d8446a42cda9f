// The render's own index over the photons of the benchmark.
#pragma once

#include "bench/micro/photons.h"
#include "render/cell_index.h"

namespace quasilux {

constexpr unsigned microClasses = 1u << LIGHT_DIFFUSE;
constexpr size_t microPhotonFields = 8; ///< PHOTON_X to PHOTON_DIRECTION (kernels/photon_grid.clh)

/// Compiler options for photon_map.cl and what includes density.clh.
std::string microPhotonOptions();

class MicroIndex {
public:
    MicroIndex(Device& device, const MicroPhotons& photons, float radius)
        : device_(device), photons_(device, photons.photons, "photons as traced"),
          regions_(device, photons.regions, "photon regions"), geometry_(device, DeviceScene{}),
          program_(device, "photon_map.cl", microPhotonOptions()),
          index_(device, program_, microClasses, microPhotonFields, "photon") {
        index_.makeTable(unsigned(photons.photons.size()), unsigned(photons.regions.size()));
        index_.map().regionCapacity = photons.regionCapacity;
        for (float& r : index_.map().radius) r = radius;
    }

    void sort() {
        index_.sort(photons_, regions_, geometry_, photons_.size());
        device_.finish();
    }
    CellIndex& index() { return index_; }

private:
    Device& device_;
    Buffer<shared::Photon> photons_;
    Buffer<shared::RegionCount> regions_;
    GeometryBuffers geometry_;
    Program program_;
    CellIndex index_;
};

} // namespace quasilux
