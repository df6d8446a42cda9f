// From the half planes that a file lists to the whole sphere of a Goniogram.
#pragma once

#include "scene/goniograms/goniogram.h"

#include <vector>

namespace quasilux {

/// Intensities along one half plane, by polar angle.
struct HalfPlane {
    double azimuth; ///< degrees
    std::vector<double> candela;
};

/// Adds to each half plane what it is mirrored to about the plane through `axis` degrees, unless there is one already.
void mirrorPlanes(std::vector<HalfPlane>& planes, double axis);

/// Sets grid and candela. Beyond the first and the last polar angle, in [0, 180], it is dark; the planes are those of
/// all the way round unless they end, in which case it is dark between the last one and the first.
void setSphere(Goniogram& goniogram, const std::vector<double>& polar, std::vector<HalfPlane> planes, bool goesRound);

} // namespace quasilux
