// Guth's position index: how much less a source glares that lies off the line of sight.
#pragma once

#include <glm/glm.hpp>

namespace quasilux {

/// An eye's axes, unit.
struct LineOfSight {
    glm::dvec3 direction{0, 1, 0}, up{0, 0, 1};
};

/// Position index p of what is seen along the unit vector `towards`, at least 1; infinity behind the eye. Above the
/// line of sight the fit to Guth's data of Levin 1975 ("Position index in VCP calculations", J. IES 4), with the angle
/// tau from the vertical to the plane of source and line of sight, and the angle sigma between both, in degrees:
///     ln p = (35.2 - 0.31889 tau - 1.22 exp(-2 tau / 9)) 1e-3 sigma + (21 + 0.26667 tau - 0.002963 tau^2) 1e-5
///     sigma^2.
/// Within 5 % of the table of CIE 117:1995. Below the line of sight, where Guth had no data, as mirrored: UGR asks for
/// none there.
double positionIndex(const LineOfSight& sight, const glm::dvec3& towards);

/// Below the line of sight for daylight: Iwata & Tokura 1997 as Wienold & Christoffersen 2006 take it, with R the
/// distance of the source from the line of sight at the depth D: 1 + 0.8 R / D, from R = 0.6 D on 1 + 1.2 R / D.
double positionIndexOfDaylight(const LineOfSight& sight, const glm::dvec3& towards);

} // namespace quasilux
