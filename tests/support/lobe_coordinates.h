// Coordinates in which lobes of any width look alike, so that one grid suits them all. They place grid cells and give
// the area element by geometry alone; the densities under test come from the kernels.
#pragma once

#include "shared_types.h"

#include <glm/glm.hpp>

namespace quasilux {

/// A direction with its solid angle per unit of (s, phi); no direction of the sphere: solidAngle = 0.
struct LobeDirection {
    glm::dvec3 wi;
    double solidAngle;
};

/// s in [0,1], phi in [0, 2 pi]. Lambert: s = wi.z. Phong: s = 1 - cos^(n+1) of the angle to the mirror direction.
/// Microfacets: 1 - s and phi are cosine and azimuth of the half vector after its slopes are divided by the roughness;
/// the density of visible GGX normals has no pole there.
LobeDirection lobeDirection(const shared::Lobe& lobe, glm::dvec3 wo, double s, double phi);

struct LobeCoordinates {
    double s, phi;
};
LobeCoordinates lobeCoordinates(const shared::Lobe& lobe, glm::dvec3 wo, glm::dvec3 wi);

/// f of the lobe in double, written down independently of the kernels (grey reflectance 1 and Fresnel factor 1).
double lobeFormula(const shared::Lobe& lobe, glm::dvec3 wo, glm::dvec3 wi);

/// D(h) and Smith's G1(v) of microfacet lobes, in double.
double microfacetDistribution(const shared::Lobe& lobe, glm::dvec3 h);
double microfacetShadowing(const shared::Lobe& lobe, glm::dvec3 v);

} // namespace quasilux
