// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/adaptive_radius.h"
#include "render/photon_stage.h"

namespace quasilux {

class CameraStage {
public:
    /// `radii`: of the pixels, or null where they are one radius (then the options do not say ADAPTIVE_RADIUS).
    CameraStage(Device& device, const std::string& options, const GeometryBuffers& geometry, Film& film,
                shared::CameraParams params, AdaptiveRadius* radii);

    /// One path per pixel.
    void run(unsigned pass, const PhotonStage& photons);
    double buildSeconds() const { return program_.buildSeconds(); }

private:
    const GeometryBuffers& geometry_;
    void launch(Film& film, const Buffer<float>* radiusScales, const PhotonStage& photons);
    void runPilot(const PhotonStage& photons);

    Film& film_;
    AdaptiveRadius* radii_;
    Program program_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
};

} // namespace quasilux
