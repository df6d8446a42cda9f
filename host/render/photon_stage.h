// Stages 1 and 2 of a pass: trace photons by kernels/photon_trace.cl, index them by kernels/photon_map.cl
// and record_sort.cl.
#pragma once

#include "render/meter_sums.h"
#include "render/pass_part.h"
#include "render/photon_arrays.h"
#include "render/trace_count.h"

#include <array>
#include <cstdint>
#include <optional>

namespace quasilux {

/// What one pass traced and stored.
struct PhotonPassCount : TraceCount {
    std::array<uint64_t, PHOTON_SLOTS> stored{}; ///< by slot of the map: classes on surfaces, then in media
};

class PhotonStage {
public:
    /// `pass`: of --map photons; `classes` are bits 1 << LIGHT_* or 1 << VOLUME_SLOT(LIGHT_*); `storesDepth` where
    /// the kernels are compiled with HAS_DEPTH_LIMIT; room for so many `photons` saves enlarging the buffers
    /// later.
    PhotonStage(Device& device, const Program& pass, const GeometryBuffers& geometry, shared::PhotonParams params,
                unsigned classes, bool storesDepth, std::optional<uint64_t> photons = std::nullopt);

    /// The buffers of passes of so many `paths` that store so many `photons`, by label.
    static BufferSizes plan(unsigned paths, uint64_t photons, unsigned classes, bool storesDepth,
                            const DeviceInfo& device);

    /// Traces the photons of a pass, or of a part of it, and indexes them with these radii, by class. A photon buffer
    /// that proves too small is enlarged and the pass traced again, so none is lost. `volumeScale` is that of kernels
    /// in media to their first size.
    PhotonPassCount run(unsigned pass, PassPart part, const std::array<float, LIGHT_CLASSES>& radius,
                        float volumeScale);

    /// From now on photons in media are kept with these probabilities, by class, and weigh accordingly more.
    void thinVolume(const std::array<float, LIGHT_CLASSES>& keepProbability);

    /// From now on radii are those of `run` times the factors of the field.
    void useField(const shared::RadiusField& field) { photons_.table().map().field = field; }

    /// From now on photons that cross the meter are counted; kernels are compiled with HAS_METER_PHOTONS then.
    void countAt(MeterSums& meter) { meter_ = &meter; }

    /// Photons emitted in a pass: none where no path can use any class.
    unsigned photonsPerPass() const { return classes_ == 0 ? 0 : params_.paths; }
    /// Has compiled, after a pass of few photons, what only those of many would otherwise.
    void compile() { photons_.compile(); }

    /// The photons of the last pass, sorted.
    const Buffer<uint32_t>& sorted() const { return photons_.sorted(); }
    const CellTable& table() const { return photons_.table(); }

private:
    std::vector<shared::RegionCount> trace();

    const GeometryBuffers& geometry_;
    Kernel tracePhotons_;
    PhotonArrays photons_;
    shared::PhotonParams params_;
    uint64_t seed_;
    unsigned classes_; // bits 1 << slot
    MeterSums* meter_ = nullptr;
    Buffer<shared::RegionCount> regions_;
};

} // namespace quasilux
