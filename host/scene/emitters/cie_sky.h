// CIE standard general sky: CIE S 011/E:2003 (ISO 15469:2004).
#pragma once

#include <glm/glm.hpp>

namespace quasilux {

inline constexpr int cieSkyTypes = 16; ///< 16: the traditional overcast sky

/// Whether the sun has its glow in it; not so of the overcast and uniform skies 1, 3, 5 and 16, whose indicatrix is 1.
bool dependsOnSun(int type);

/// Luminance over that of the zenith, along a unit direction to the sky; up is +z. `sun`: unit, towards it. 0 below the
/// horizon.
double cieSkyLuminance(int type, const glm::dvec3& direction, const glm::dvec3& sun);

/// Illuminance of the ground under a sky whose zenith has luminance 1.
double cieSkyIlluminance(int type, const glm::dvec3& sun);

} // namespace quasilux
