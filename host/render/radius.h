// Density radius by pass (Knaus & Zwicker 2011, "Progressive photon mapping: a probabilistic approach").
#pragma once

#include "shared_types.h"

namespace quasilux {

/// Share of the photons of a pass that the disc keeps from pass to pass: r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1), eq.
/// 20; i counts from 1, so r_1 is the radius of pass 0.
inline constexpr double radiusAlpha = 2.0 / 3.0;

/// Radius of pass 0 in scene units, so that a disc holds `photonsInDisc` of the `photons` emitted, were they spread
/// evenly over `area`. No constant in scene units: it scales with the scene.
double initialRadius(double area, unsigned photons);

/// Radius of pass 0 where so many photons lie on a unit of area.
double radiusOfPhotons(double perArea);

/// Radius of pass `pass` as a fraction of that of pass 0: from the number of the pass alone, so passes may be
/// rendered in any order.
double radiusShrink(unsigned pass);

/// Size of density kernels in media in pass `pass` as a fraction of that of pass 0; they shrink in all directions.
double volumeShrink(unsigned pass);

/// Classes whose light varies faster over a surface get a smaller radius; factor on initialRadius.
double classRadiusFactor(unsigned lightClass);

} // namespace quasilux
