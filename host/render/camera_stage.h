// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/film.h"
#include "render/photon_stage.h"

namespace quasilux {

class CameraStage {
public:
    CameraStage(const Program& pass, const GeometryBuffers& geometry, Film& film, shared::CameraParams params);

    /// Has the runtime compile the kernel, by a launch of as many work-items as a pass has, which do nothing.
    void compile(const PhotonStage& photons);

    /// One path per pixel.
    void run(unsigned pass, const PhotonStage& photons);

private:
    const GeometryBuffers& geometry_;
    Film& film_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
};

} // namespace quasilux
