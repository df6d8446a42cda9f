// The unit of flux as it is stored of photons (kernels/packed_flux.clh).
#pragma once

namespace quasilux {

/// A power of two for a pass of `paths` photons, `emittedFlux` W (mean of R, G, B) together: packed flux reaches from 2^-30 of it
/// to 2 of them.
float fluxUnit(double emittedFlux, unsigned paths);

} // namespace quasilux
