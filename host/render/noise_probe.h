// Finds where camera paths have their noise, before the first pass (docs/method/camera-paths.md).
#pragma once

#include "render/camera_stage.h"
#include "render/pass_photons.h"
#include "render/path_allocation.h"
#include "render/sampling_gain.h"

namespace quasilux {

/// Traces photons, where they are taken, and coarse camera paths; leaves nothing in the image. What it finds is a
/// function of the scene, the settings and the seed alone, but for times.
class NoiseProbe {
public:
    /// `classes`: bits of the light that photons carry. `pathsByPixel`: of a pass of the image, in the mean.
    NoiseProbe(Device& device, CameraStage& paths, PassPhotons& photons, const shared::Camera& camera, unsigned classes,
               unsigned pathsByPixel);

    /// Its buffers, by label, while it runs.
    static BufferSizes plan(const shared::Camera& camera);
    /// Camera paths that it traces, with those of gain(), as a multiple of the image's pixels.
    static double costByPixel(const shared::Camera& camera, unsigned pathsByPixel);

    /// Paths in a pass of each block of coarseBlock() pixels, at no more than the cost of equally many in all.
    std::vector<uint32_t> allocate();
    SamplingGain gain();

private:
    void measure(unsigned classes);
    FilmImage render(CameraStage::Brings brings, unsigned from, unsigned passes);
    std::vector<double> costByBlock();
    double secondsOf(const PathCounts& paths);

    Device& device_;
    CameraStage& paths_;
    PassPhotons& photons_;
    shared::Camera coarse_;
    unsigned pathsByPixel_;
    unsigned passes_, pathsOfPass_; // of each half
    PathNoise halves_[2];
};

} // namespace quasilux
