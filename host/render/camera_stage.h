// Stage 3 of a pass: camera paths by kernels/camera_paths.cl, into the film.
#pragma once

#include "render/adaptive_radius.h"
#include "render/path_counts.h"
#include "render/photon_stage.h"
#include "render/shared_samples.h"

namespace quasilux {

/// The kernel of camera paths, by which its time is known.
inline constexpr const char* cameraKernel = "traceCameraPaths";

/// What camera paths read by pixel.
struct PixelTables {
    const PathCounts& paths;
    const Buffer<float>* radiusScales; ///< null where the options do not say ADAPTIVE_RADIUS
};

class CameraStage {
public:
    /// `radii`: of the pixels, or null where they are one radius (then the options do not say ADAPTIVE_RADIUS).
    /// `shared`: what pixels share, or null where each has samples of its own. `paths`: camera paths of each pixel in a
    /// pass, at first.
    CameraStage(Device& device, const Program& pass, const GeometryBuffers& geometry, Film& film,
                shared::CameraParams params, unsigned paths, AdaptiveRadius* radii, SharedSamples* shared);

    /// Its own buffers, by label.
    static BufferSizes plan(const shared::Camera& camera, bool isAdaptive);

    /// Has the runtime compile the kernels, by a launch of as many work-items as a pass has, which do nothing.
    void compile(const PhotonStage& photons);

    /// Of the camera paths of a pass, or of a part of it, with its photons.
    shared::CameraParams params(unsigned pass, const PhotonStage& photons, PassPart part = {}) const;

    /// What these read by pixel.
    PixelTables tables(unsigned pass) const;
    void setPaths(PathCounts paths) {
        paths_ = std::move(paths);
        traceCameraPaths_.forgetPace(); // work-items had other paths
    }
    const PathCounts& paths() const { return paths_; }

    void run(unsigned pass, const PhotonStage& photons, PassPart part);

    /// The same without photons, to learn what it takes: one path of each pixel, into the film.
    void runWithoutGathering(const PhotonStage& photons);

    /// What the paths of a coarse camera bring: light that they find themselves, that and what photons carry, or how
    /// many rays they follow, as an image.
    enum class Brings { ownLight, allLight, rays };
    /// Pass `pass` of a coarse camera, `paths` of each of its pixels, a batch of its film; random numbers are its own.
    /// They begin within a single pixel of the image, in the middle: what differs between pixels is no noise.
    void runCoarse(Film& film, const shared::Camera& camera, unsigned pass, Brings brings, const PathCounts& paths,
                   const PhotonStage& photons);

    /// Are radii by pixel to be chosen with the photons of this pass? Then chooseRadius() is to follow run().
    bool radiusIsDue(unsigned pass) const;
    /// Returns how many camera paths it traced. `photons` are those of this part of `pass`.
    size_t chooseRadius(unsigned pass, const PhotonStage& photons, PassPart part);

private:
    void tracePart(Film& film, Film::Part& part, shared::CameraParams params, size_t pixels, const PixelTables& tables,
                   const PhotonStage& photons);
    SharedSamples::Trace tracer(Film& film, const PixelTables& tables, const PhotonStage& photons);
    void launch(size_t workItems, Buffer<float>& result, Film& film, const shared::CameraParams& params,
                const PixelTables& tables, const PhotonStage& photons);
    void runOn(Film& film, const Film::Pass& onFilm, shared::CameraParams params, const PixelTables& tables,
               const PhotonStage& photons);
    const Buffer<float>* radiusScales(unsigned pass) const { return radii_ ? &radii_->scales(pass) : nullptr; }

    const GeometryBuffers& geometry_;
    Film& film_;
    AdaptiveRadius* radii_;
    SharedSamples* shared_;
    PathCounts paths_, onePath_;
    Kernel traceCameraPaths_;
    shared::CameraParams params_;
};

} // namespace quasilux
