// The Unified Glare Rating (CIE 117:1995): how much luminaires glare for an eye.
#pragma once

#include "photometry/occlusion.h"
#include "photometry/position_index.h"

#include <string>
#include <vector>

namespace quasilux {

/// What an eye sees of one luminaire.
struct GlareSource {
    std::string name;
    double luminance = 0;     ///< cd/m², mean over the luminous area towards the eye
    double solidAngle = 0;    ///< sr, of what is seen of it
    double positionIndex = 1; ///< mean over it, as 1 / p² counts
    double visible = 1;       ///< share of the luminous area that nothing hides

    /// L² ω / p².
    double strength() const { return luminance * luminance * solidAngle / (positionIndex * positionIndex); }
};

struct GlareSources {
    std::vector<GlareSource> seen;    ///< the strongest first
    std::vector<std::string> leftOut; ///< why some luminaires are not rated, a sentence each

    double strength() const;
};

/// Luminaires (quasilux_ies, by intensity / luminous area towards the eye) and shapes that emit, as seen by the
/// observer. The sky and the sun are no luminaires. `photometric`: what the scene's radiances are.
GlareSources glareSources(const Scene& scene, const Observer& observer, const Occlusion& occlusion, bool photometric);

/// 8 log10(0.25 / Lb · Σ L² ω / p²) and its standard error, with the background luminance Lb = Ei / π of the
/// vertical illuminance at the eye without the sources' direct light, lx. NaN where that is not above 0: there is no
/// background then.
struct GlareRating {
    double value = 0, standardError = 0;
};
GlareRating unifiedGlareRating(double strength, double indirectIlluminance, double standardError);

/// CIE 117 is of sources of 0.0003 to 0.1 sr.
inline constexpr double smallestSource = 0.0003, largestSource = 0.1;

} // namespace quasilux
