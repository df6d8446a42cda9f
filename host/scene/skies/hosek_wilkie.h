// Clear skies: L. Hosek & A. Wilkie, An analytic model for full spectral sky-dome radiance (2012), and their solar radiance function
// (2013), by their RGB data.
#pragma once

#include "scene/color.h"

#include <array>
#include <glm/glm.hpp>

namespace quasilux {

/// Angle of the sun's disc for which its radiance is stated, radians.
double hosekWilkieSunAperture();
/// Width in nm by which its radiances, means over wavelengths, become what 683 lm/W holds for: the integral of the eye's response.
double hosekWilkieResponse();

/// Radiance of the sky in linear sRGB, W m^-2 sr^-1 nm^-1 as Mitsuba has it: a mean over wavelengths weighted by the eye's response.
/// Channels may be negative where sRGB does not hold the colour.
class HosekWilkieSky {
public:
    /// Turbidity within [1, 10], channels of the albedo within [0, 1], elevation of the sun in radians, within [0, pi/2].
    HosekWilkieSky(double turbidity, Rgb albedo, double sunElevation);
    /// By the cosines of the angles from the zenith (at least 0) and from the sun.
    glm::dvec3 radiance(double cosZenith, double cosSun) const;

private:
    struct Channel {
        std::array<double, 9> shape;
        double radiance;
    };
    std::array<Channel, 3> channels_{};
};

/// Radiance of the sun's disc in the same unit.
class HosekWilkieSun {
public:
    explicit HosekWilkieSun(double turbidity) : turbidity_(turbidity) {}
    /// Of a point of the disc at this elevation (radians); `cosSurface`: from the normal of the sun there to the eye, which darkens the limb.
    glm::dvec3 radiance(double elevation, double cosSurface) const;
    /// Mean over the disc of a sun at this elevation: linear between elevations of 2, 5, ... 89 degrees and the same below and above,
    /// as Mitsuba has its plain sun.
    glm::dvec3 meanRadiance(double elevation) const;

private:
    glm::dvec3 discMean(double elevation) const;
    double turbidity_;
};

} // namespace quasilux
