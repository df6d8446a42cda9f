// The all-weather sky: R. Perez, R. Seals & J. Michalsky, Solar Energy 50(3), 1993, 235-245, with the erratum in 51(5),
// 423; luminous efficacies and the terms clearness and brightness by R. Perez et al., Solar Energy 44(5), 1990,
// 271-289.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace quasilux {

/// What a weather station measures.
struct Radiation {
    double directNormal = 0;      ///< W/m^2 across the beam of the sun
    double diffuseHorizontal = 0; ///< W/m^2 on the ground, by the sky, above 0
    double dewPoint = 11;         ///< degrees Celsius near the ground: 2 cm of water in the air above
    double sunNearness = 1;       ///< irradiance outside the atmosphere over its mean of the year
};

class PerezSky {
public:
    /// `sun`: unit, towards it, z at least 0.
    PerezSky(const Radiation& radiation, const glm::dvec3& sun);

    double clearness() const { return clearness_; }
    double brightness() const { return brightness_; }
    double directEfficacy() const { return directEfficacy_; }   ///< lm/W
    double diffuseEfficacy() const { return diffuseEfficacy_; } ///< lm/W
    /// Relative, of the sky along a unit direction; 0 below the horizon and where the formula is negative.
    double luminance(const glm::dvec3& direction) const;

private:
    glm::dvec3 sun_;
    double clearness_, brightness_, directEfficacy_, diffuseEfficacy_;
    std::array<double, 5> shape_; ///< a, b: gradation from the horizon; c, d, e: about the sun
};

/// The radiation whose illuminances by these efficacies are the stated ones, lx; `about`: dew point and nearness of the
/// sun. Where efficacies jump between categories so that there is none, one beside the jump.
Radiation radiationOfIlluminances(double directNormal, double diffuseHorizontal, Radiation about,
                                  const glm::dvec3& sun);

} // namespace quasilux
