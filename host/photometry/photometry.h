// Figures that lighting engineers read off a goniogram (docs/reference/photometry.md).
#pragma once

#include "drawing/drawing.h"
#include "scene/goniograms/goniogram.h"

#include <array>

namespace quasilux {

/// Two opposite half planes through the photometric axis.
struct PlaneAngles {
    double c = 0;     ///< degrees: of the plane C, C + 180
    double beam = 0;  ///< degrees between the directions about the plane's largest intensity where half of it is left
    double field = 0; ///< a tenth of it
};

struct LuminanceRow {
    double gamma = 0;
    double c0 = 0, c90 = 0, highest = 0; ///< cd/m²; `highest` of all C
};

struct Photometry {
    double lumens = 0, upwardLumens = 0;
    double lampLumens = 0; ///< 0: absolute photometry of an IES file, which says none
    double watts = 0;
    double largest = 0, largestC = 0, largestGamma = 0; ///< candela, and where
    std::array<PlaneAngles, 2> planes;                  ///< C0 and C90
    std::vector<LuminanceRow> luminances; ///< for gamma 45 to 85; empty where the luminous shape is a point

    /// lm/W; 0 where watts are not said.
    double efficacy() const { return watts > 0 ? lumens / watts : 0; }
};

Photometry photometryOf(const Goniogram& goniogram);

/// Candela along the half plane C at gamma, or along C + 180 where gamma is negative.
double intensityInPlane(const Goniogram& goniogram, double c, double gamma);

/// Intensities in the planes C0–C180 and C90–C270.
Drawing polarCurve(const Goniogram& goniogram);

} // namespace quasilux
