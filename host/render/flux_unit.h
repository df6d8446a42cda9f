// The unit of flux as it is stored of photons (kernels/packed_flux.clh).
#pragma once

namespace quasilux {

/// For a pass of `paths` photons, `emittedFlux` W (mean of R, G, B) together: packed flux reaches from 2^-30 of it to 2
/// of them. In proportion to the emitted flux, not a power of two: so a scene in other units or of another size, or
/// with brighter lamps, has its photons rounded as before, and makes the same image.
float fluxUnit(double emittedFlux, unsigned paths);

struct DeviceScene;
/// The same where photons are guided: few of them carry the flux of plain ones, most far less.
float fluxUnit(const DeviceScene& scene, unsigned paths);

} // namespace quasilux
