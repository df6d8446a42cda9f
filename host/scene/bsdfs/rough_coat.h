// What a dielectric border of microfacets does to diffuse light: the coat of <bsdf type="roughplastic">.
#pragma once

#include <array>

namespace quasilux {

struct RoughCoat {
    bool ggx = false; ///< else Beckmann
    double alpha = 0.1;
    double eta = 1.5; ///< index of the coat over that outside

    /// Share of the light from this cosine that one scattering at the border lets in.
    double transmitted(double cosine) const;
    /// Share of diffuse light that the border sends back from inside, as Mitsuba takes it: the mean over 64 cosines at
    /// equal steps from 0 to 1, both included, of 2 cos R.
    double internalReflectance() const;
};

/// A function of the cosine as kernels/bsdf/lobes/roughcoatedlambert.clh evaluates it.
struct CoatFit {
    double knee = 0.1; ///< the variable is cosine / (cosine + knee)
    /// Of coats under a denser medium, else 0. Above 0: the variable is another, of the cosine inside, and this is how
    /// wide the critical angle is; below: roughness has blurred that away.
    double edge = 0;
    double eta = 1;                  ///< RoughCoat's
    double scale = 1, offset = 0;    ///< of the other variable
    std::array<double, 8> factors{}; ///< of its powers, from 0 on
    double variable(double cosine) const;
    double operator()(double cosine) const;
    /// Integral of 2 cos times the function: what is let in of diffuse light.
    double ofDiffuseLight() const;
};

/// Fits RoughCoat::transmitted for every alpha from 0.01 to 1: with a relative error below 0.3 % where eta is above 1;
/// below 1 by 0.7 % of all light in the mean, and near the critical angle by 3 %, where Mitsuba's own table of 64
/// cosines is off by as much.
CoatFit fitTransmission(const RoughCoat& coat);

} // namespace quasilux
