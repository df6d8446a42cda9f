// What the skies in photometric units share: sky and ground as surroundings, the sun as parallel light
// (docs/reference/photometry.md).
#pragma once

#include "scene/properties.h"

#include <functional>

namespace quasilux {

/// +x is the east, +y the north, +z up.
struct Daylight {
    glm::dvec3 sun{0, 0, 1};                            ///< unit, towards it
    double skyIlluminance = 0;                          ///< lx, of the ground
    double sunIlluminance = 0;                          ///< lx, of a surface that faces the sun
    std::function<double(const glm::dvec3&)> luminance; ///< of the sky in cd/m^2, by a unit direction
};

/// Of the ground, lx, under a sky of this luminance.
double illuminanceOnGround(const std::function<double(const glm::dvec3&)>& luminance);

/// Adds it to the scene by the emitter's parameters ground_albedo, tint or colour_temperature, and to_world.
void addDaylight(Properties& properties, Surroundings& surroundings, const Daylight& daylight);

} // namespace quasilux
