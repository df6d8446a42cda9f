// The render's own index over the photons of the benchmark.
#pragma once

#include "bench/micro/photons.h"
#include "render/photon_arrays.h"

namespace quasilux {

constexpr unsigned microClasses = 1u << LIGHT_DIFFUSE;
constexpr size_t microPhotonFields = 6; ///< PHOTON_X to PHOTON_DIRECTION (kernels/photon_grid.clh)

/// Compiler options for photon_map.cl and what includes density.clh.
std::string microPhotonOptions();

inline Program microProgram(Device& device) {
    Program program(device, "photon_map.cl", microPhotonOptions());
    program.add("every_scene.cl", "");
    return program;
}

class MicroIndex {
public:
    MicroIndex(Device& device, const MicroPhotons& photons, float radius)
        : device_(device), geometry_(device, DeviceScene{}), program_(microProgram(device)),
          arrays_(device, program_, microClasses, false) {
        arrays_.make(photons.photons.size(), unsigned(photons.regionEnds.size()));
        shared::MapParams& map = arrays_.table().map();
        map.fluxUnit = 1;
        for (float& r : map.radius) r = radius;
        traced_ = layOutPhotons(photons.photons, photons.regionEnds, map.photonStride, false);
        regions_ = Buffer<shared::RegionCount>(device, traced_.regions, "photon regions");
        putBack();
    }

    /// As traced: sorting takes place in the same memory.
    void putBack() {
        arrays_.arrays().write(traced_.arrays);
        arrays_.blocks().write(traced_.blocks);
    }
    void sort() {
        arrays_.sort(regions_, traced_.regions, geometry_);
        device_.finish();
    }
    CellTable& table() { return arrays_.table(); }
    const Buffer<uint32_t>& sorted() const { return arrays_.sorted(); }

private:
    Device& device_;
    GeometryBuffers geometry_;
    Program program_;
    PhotonArrays arrays_;
    TracedLayout traced_;
    Buffer<shared::RegionCount> regions_;
};

} // namespace quasilux
