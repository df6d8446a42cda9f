// The rough dielectrics in double, by Walter et al. 2007, and integrals over them: what the tests compare with.
#pragma once

#include "support/chi_squared.h"
#include "support/lobe_cases.h"

namespace quasilux {

/// A rough dielectric of LOBE_GGXDIELECTRIC or LOBE_BECKMANNDIELECTRIC that loses nothing but by shadowing.
shared::Lobe makeInterface(unsigned type, float eta, float alphaU, float alphaV);

/// Both distributions, smooth to rough, seen from both sides.
std::vector<LobeCase> roughInterfaces();

/// f of radiance, wo being the side of the observer (eq. 20 and 21).
double interfaceFormula(const shared::Lobe& lobe, glm::dvec3 wo, glm::dvec3 wi);

/// Cells over the microfacets, whose coordinates are those of lobeDirection for microfacets; for each part.
constexpr SampleGrid interfaceGrid{0, 1, 0, 6.283185307179586, 10, 16};
/// Cell of wi, those of transmission after those of reflection; 2 interfaceGrid.cells() if outside.
int interfaceCell(const shared::Lobe& lobe, glm::dvec3 wo, glm::dvec3 wi);

struct InterfacePoint {
    glm::dvec3 wi;
    double solidAngle; ///< that the point stands for
    int cell;
};
/// A midpoint rule over all wi that some facet sends to wo.
std::vector<InterfacePoint> interfaceQuadrature(const shared::Lobe& lobe, glm::dvec3 wo, int pointsPerSide);

/// Integrals of f |cos wi|: of radiance, so a lossless smooth interface has reflected + eta^2 transmitted = 1.
struct InterfaceShares {
    double reflected = 0, transmitted = 0;
};
InterfaceShares interfaceShares(const shared::Lobe& lobe, glm::dvec3 wo);

/// Radiance of a ball of rough glass in surroundings of radiance 1, seen under the cosine `cosine` to its normal;
/// isotropic lobe as seen from outside. Chords of a ball meet it under the same angle at both ends, so the radiance
/// inside depends on one cosine only and solves a linear equation in it.
class BallRadiance {
public:
    explicit BallRadiance(const shared::Lobe& outside);
    double operator()(double cosine) const;

private:
    shared::Lobe outside_;
    std::vector<double> inside_; ///< radiance that goes out at the middles of equal steps of the cosine
};

} // namespace quasilux
