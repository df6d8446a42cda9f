// What camera paths by pixel are worth (noise_probe.h).
#pragma once

namespace quasilux {

/// Against the same number of camera paths in all pixels.
struct SamplingGain {
    double variance = 1; ///< of what paths find themselves: that of even sampling over that by pixel
    double time = 1;     ///< of these paths: that by pixel over that of even sampling
};

} // namespace quasilux
