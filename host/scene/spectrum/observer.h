// The eye and the daylight by which spectra become colours: CIE 1931 standard observer and CIE illuminant D65.
#pragma once

namespace quasilux {

/// Tables cover these wavelengths, nm; beyond them the observer sees nothing.
inline constexpr double shortestWavelength = 360, longestWavelength = 830;

struct ObserverSample {
    double x, y, z; ///< colour matching functions
    double d65;     ///< relative power of illuminant D65, 100 at 560 nm
};

/// Linear between the values of the tables, every 5 nm. `wavelength` within the range above.
ObserverSample observerAt(double wavelength);

} // namespace quasilux
