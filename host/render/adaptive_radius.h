// Density radius by block of pixels and class of light, chosen from a pilot (docs/density.md, "Radius by pixel").
#pragma once

#include "device/program.h"
#include "render/film.h"

#include <map>
#include <optional>
#include <string>

namespace quasilux {

/// No pixel's radius is more than this many times the fixed one. CELLS_REACHED of kernels/density.clh.
inline constexpr float largestAdaptiveRadius = 2;
/// First passes, in which all pixels still have the fixed one.
inline constexpr unsigned passesOfEqualRadius = 4;

class AdaptiveRadius {
public:
    /// `pass`: with ADAPTIVE_RADIUS among its options. `classes`: bits of the photon classes in use.
    AdaptiveRadius(Device& device, const Program& pass, const shared::Camera& camera, unsigned classes);

    /// Bytes of its buffers by label, as Device::allocations() has them.
    static std::map<std::string, uint64_t> plan(const shared::Camera& camera, unsigned classes);
    /// Has the runtime compile the kernels.
    void compile();

    /// Is the next pass one of the pilot's: is the bias of coarse pixels to be estimated, at the largest radius, with its
    /// photons?
    bool pilotIsDue() const { return film_.has_value(); }
    const shared::Camera& pilotCamera() const { return camera_; }
    Film& pilotFilm() { return *film_; }
    const Buffer<float>& pilotScales() const { return pilotScales_; }
    /// To be called when the pilot's film has taken `pass`. Chooses the radii anew after 4, 8 and 16 passes, and ends the pilot.
    void endPilotPass(unsigned pass);

    /// Radius of each block by that of the map, radiusIndex() in kernels/adaptive_radius.clh; 1 until radii are chosen.
    const Buffer<float>& scales() const { return scales_; }
    /// Pixels of a row and column that share a radius.
    unsigned block() const { return block_; }

private:
    unsigned block_;
    shared::Camera camera_;
    std::optional<Film> film_; ///< until the pilot has ended
    Kernel measureRadii_, chooseRadii_;
    Buffer<float> scales_, pilotScales_;
    Buffer<shared::RadiusMeasure> measures_;
    unsigned passes_ = 0;
    double squaredRadii_ = 0, inverseSquares_ = 0; ///< shared::RadiusParams
};

} // namespace quasilux
