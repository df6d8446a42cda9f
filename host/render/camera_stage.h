// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/adaptive_radius.h"
#include "render/photon_stage.h"
#include "render/shared_samples.h"

namespace quasilux {

/// The kernel of camera paths, by which its time is known.
inline constexpr const char* cameraKernel = "traceCameraPaths";

class CameraStage {
public:
    /// `radii`: of the pixels, or null where they are one radius (then the options do not say ADAPTIVE_RADIUS). `shared`: what pixels share,
    /// or null where each has samples of its own.
    CameraStage(const Program& pass, const GeometryBuffers& geometry, Film& film, shared::CameraParams params,
                AdaptiveRadius* radii, SharedSamples* shared);

    /// Has the runtime compile the kernels, by a launch of as many work-items as a pass has, which do nothing.
    void compile(const PhotonStage& photons);

    /// Of a pass's camera paths, with its photons.
    const shared::CameraParams& params(unsigned pass, const PhotonStage& photons);

    /// CameraParams::cameraPaths of each pixel.
    void run(unsigned pass, const PhotonStage& photons);

    /// The same without photons, to learn what it takes: one path of each pixel, into the film.
    void runWithoutGathering(const PhotonStage& photons);

    /// Are radii by pixel to be chosen with the photons of this pass? Then chooseRadius() is to follow run().
    bool radiusIsDue(unsigned pass) const;
    /// Returns how many camera paths it traced. `photons` are those of `pass`.
    size_t chooseRadius(unsigned pass, const PhotonStage& photons);

private:
    void tracePart(Film& film, Film::Part& part, shared::CameraParams params, size_t pixels,
                   const Buffer<float>* radiusScales, const PhotonStage& photons);
    SharedSamples::Trace tracer(Film& film, const Buffer<float>* radiusScales, const PhotonStage& photons);
    void launch(size_t workItems, Buffer<float>& result, Film& film, const shared::CameraParams& params,
                const Buffer<float>* radiusScales, const PhotonStage& photons);
    void runOn(Film& film, shared::CameraParams params, const Buffer<float>* radiusScales, const PhotonStage& photons);

    const GeometryBuffers& geometry_;
    Film& film_;
    AdaptiveRadius* radii_;
    SharedSamples* shared_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
};

} // namespace quasilux
