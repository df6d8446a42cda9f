// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/film.h"
#include "render/photon_stage.h"

namespace quasilux {

class CameraStage {
public:
    CameraStage(Device& device, const std::string& options, const GeometryBuffers& geometry, Film& film,
                shared::CameraParams params);

    /// One path per pixel.
    void run(unsigned pass, const PhotonStage& photons);
    double buildSeconds() const { return program_.buildSeconds(); }

private:
    const GeometryBuffers& geometry_;
    Film& film_;
    Program program_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
};

} // namespace quasilux
