// The error that a render of these settings will have, from a few of its passes (docs/method/auto.md).
#pragma once

#include "render/error_estimate.h"
#include "render/sampling_gain.h"

#include <vector>

namespace quasilux {

/// What a few passes estimate: error by tile of the image, as shares of relMSE, so that the tiles' sum is the image's.
struct PilotMeasure {
    unsigned passes = 0;
    double secondsPerPass = 0;       ///< of the second half of these passes
    double secondsOfPhotons = 0;     ///< the part of them that does not grow with the camera paths of a pixel
    double secondsWithRadius = 0;    ///< the part of them that falls as radii shrink, in proportion to the discs
    std::vector<double> noise, bias; ///< by tile; the bias of a tile is net of noise and may come out below 0
    double noiseOfPhotons = 0;       ///< share of the noise that more camera paths with the same photons do not lower
    double noiseOfCaustics = 0;      ///< share of the noise that is in their component
    bool findsCaustics = false;      ///< camera paths find them, none come from photons
    double causticsByPaths =
        0;                  ///< relMSE of their noise at most, did one camera path a pixel find them (noiseOfFinding)
    double causticsMet = 0; ///< as many equal ones would have their noise, were they met one by one
    double biasNoise = 0;   ///< relMSE that the estimate of the bias has as noise
    double radius = 1;      ///< of the first pass's density estimate, in any unit
    bool inVolume = false;  ///< kernels shrink in three dimensions
};

/// `image` of passes 0, 1, …; `brightness` as of errorByTile(); `radiance`: of emitters, as noiseOfFinding() takes it.
PilotMeasure measurePilot(const FilmImage& image, bool hasMedia, double secondsPerPass,
                          const std::vector<float>& brightness = {}, double radiance = 0);

struct Prediction {
    double passes = 0;
    double noise = 0, bias = 0; ///< squares, shares of relMSE

    double relativeMse() const { return noise + bias; }
    /// Ratio to the image, as people read it.
    double relativeError() const;
};

/// After `passes` passes altogether.
Prediction predictAfterPasses(const PilotMeasure& pilot, double passes);
/// After `seconds` more on the clock.
Prediction predictAfter(const PilotMeasure& pilot, double seconds);
/// The same without the passes so far, which are discarded.
Prediction predictAnew(const PilotMeasure& pilot, double seconds);

/// Mean of images of the same scene (radiance of all pixels), weights inverse to their noise.
class Brightness {
public:
    void add(const std::vector<float>& radiance, const PilotMeasure& pilot);
    std::vector<float> mean() const;

private:
    std::vector<double> sum_;
    double weight_ = 0;
};

/// relMSE of each after `seconds` more on the clock. Biases that differ by less than what can be resolved, but for what
/// their radii explain, count as one.
std::vector<double> predictedErrors(const std::vector<PilotMeasure>& pilots, double seconds);

/// As it would be with so many times the camera paths of a pixel in a pass, one of which gathers for all. Nets make them
/// more even, but for the caustics that they find, of which the last events decide.
PilotMeasure withCameraPaths(PilotMeasure pilot, double factor);

inline constexpr unsigned mostCameraPaths = 64; ///< that are chosen

/// Camera paths of a pixel in a pass, a power of 2, with which a render of so many seconds by this pilot's settings,
/// which have `cameraPaths` of them, has the least error. Photons, which all paths of a pass share, cost the same
/// however many there are.
unsigned bestCameraPaths(const PilotMeasure& pilot, unsigned cameraPaths, double seconds);

/// relMSE after equal time with camera paths of all pixels alike over that with camera paths by pixel. Bias is the same
/// in both and left out.
double gainOfSampling(const PilotMeasure& pilot, const SamplingGain& gain);

/// Of camera paths, `cameraPaths` of a pixel in a pass, that find caustic light: those that seldom meet an emitter have
/// little noise until one does. So what is known of it before, `noiseOfOnePath` at most (causticsByPaths of a pilot by
/// photons), counts as one that was met.
PilotMeasure withRareCaustics(PilotMeasure pilot, double noiseOfOnePath, unsigned cameraPaths);

/// Seconds until relMSE falls to the square of `relativeError`; never above `limit`.
double secondsToError(const PilotMeasure& pilot, double relativeError, double limit);

} // namespace quasilux
