// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/film_image.h"
#include "render/photon_stage.h"

namespace quasilux {

class CameraStage {
public:
    CameraStage(Device& device, const std::string& options, const GeometryBuffers& geometry,
                shared::CameraParams params);

    /// One path per pixel.
    void run(unsigned pass, const PhotonStage& photons);
    /// Means over `passes` and their standard errors.
    FilmImage develop(unsigned passes) const;
    shared::CameraCounters counters() const { return counters_.read().front(); }
    double buildSeconds() const { return program_.buildSeconds(); }

private:
    const GeometryBuffers& geometry_;
    Program program_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
    Buffer<float> film_;
    Buffer<shared::CameraCounters> counters_;
};

} // namespace quasilux
