// Skies as images that surround the scene.
#pragma once

#include "scene/color.h"
#include "scene/scene.h"

#include <functional>
#include <vector>

namespace quasilux {

/// Rows of an image whose sky has no sun's disc: a quarter of a degree each.
inline constexpr unsigned coarsestSkyHeight = 721;

/// Solid angle over which the rows of an image of latitude and longitude count: the integral of what is 1 on a row and
/// falls linearly to 0 at those beside it. Sums to 4 pi.
std::vector<double> solidAnglesOfRows(unsigned height);

/// Irradiance of a plane that looks up, by the upper half of an image alone, as it is looked up: R, G, B.
glm::dvec3 irradianceOfGround(const EnvironmentImage& image);

/// Unit direction to the middle of a pixel, up is +z: what lies along the image's own x, y, z is that along x, z, -y
/// here. On the row of the horizon z is 0.
glm::dvec3 directionOfSkyPixel(unsigned column, unsigned row, unsigned height);

/// An image of an odd number of rows, so that one is the horizon, and twice as many columns less two. `axes`: of the
/// sky in the world. `radiance`: of the sky along a unit direction. The row of the horizon is half sky and half ground:
/// between rows the image is linear, and so walls get as much of both as they should.
EnvironmentImage makeSkyImage(unsigned height, const glm::dmat3& axes, Rgb ground,
                              const std::function<Rgb(const glm::dvec3&)>& radiance);

/// Leaves the ground what it has by the sky.
void takeSunOffGround(EnvironmentImage& image);

} // namespace quasilux
