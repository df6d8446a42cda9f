// The sun's disc as pixels of a sky's image.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <glm/glm.hpp>

namespace quasilux {

struct SunDisc {
    glm::dvec3 towards{}; ///< its middle, unit, up is +z
    double halfAngle = 0; ///< radians
    /// By a unit direction within the disc and above the horizon; no channel negative.
    std::function<glm::dvec3(const glm::dvec3&)> radiance;
};

/// Narrower discs would be lost between pixels.
double narrowestHalfAngle();

/// Rows of a sky's image on which the disc is at least four pixels wide, from 721 (a quarter of a degree each) to 1441.
unsigned skyHeightFor(double halfAngle);

/// Adds the disc to the sky. Its irradiance across the beam is exact in each channel, what of it lies below the horizon
/// left out; its edge is as sharp as the pixels.
void addSunDisc(EnvironmentImage& sky, const SunDisc& disc);

} // namespace quasilux
