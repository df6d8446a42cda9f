// What a clear pane lets pass, for tests of light behind one.
#pragma once

#include <cmath>

namespace quasilux::test {

/// Of unpolarised light by the cosine of incidence, with all reflections between the sides of a pane of this index:
/// (1 - R) / (1 + R), R of one side by Fresnel's amplitudes (Born & Wolf, sec. 1.5.2).
inline double paneTransmittance(double cosine, double index) {
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
    const double s = (cosine - index * inside) / (cosine + index * inside),
                 p = (index * cosine - inside) / (index * cosine + inside);
    const double r = (s * s + p * p) / 2;
    return (1 - r) / (1 + r);
}

} // namespace quasilux::test
