// Stage 3 of a pass whose sensor is a meter: several paths of each pixel by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/film.h"
#include "render/meter_sums.h"
#include "render/photon_stage.h"

namespace quasilux {

class MeterStage {
public:
    /// `classes` as PhotonStage takes them; `meanRadiance` as CameraMapStage.
    MeterStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
               shared::CameraParams params, unsigned classes, double meanRadiance);

    /// Its buffers, by label; `samples` of each pixel.
    static BufferSizes plan(size_t pixels, unsigned samples, unsigned classes);

    /// As CameraStage::compile.
    void compile(const PhotonStage& photons);

    /// All paths of a pass, or of a part of it; what was counted() since the last one is added.
    void run(unsigned pass, const PhotonStage& photons, PassPart part);
    MeterSums& counted() { return counted_; }

private:
    const GeometryBuffers& geometry_;
    Film& film_;
    Kernel traceMeterPaths_, addMeterSamples_;
    shared::CameraParams params_;
    MeterSums counted_;
    Buffer<float> samples_;
};

} // namespace quasilux
