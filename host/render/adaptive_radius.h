// Density radius by block of pixels and class of light, chosen from passes of a coarse camera (docs/method/radius.md,
// "Radius by pixel"). Coarse passes follow each other from 0 on, with the photons of the passes of these numbers. So
// the radii of a pass are a function of scene, settings and seed, whichever passes have been rendered.
#pragma once

#include "device/program.h"
#include "render/film.h"

#include <optional>
#include <vector>

namespace quasilux {

/// No pixel's radius is more than this many times the fixed one. CELLS_REACHED of kernels/density.clh.
inline constexpr float largestAdaptiveRadius = 2;
/// First passes, in which all pixels still have the fixed one.
inline constexpr unsigned passesOfEqualRadius = 2;

class AdaptiveRadius {
public:
    /// `pass` holds adaptive_radius.cl. `classes`: bits of the photon classes in use.
    AdaptiveRadius(Device& device, const Program& pass, const shared::Camera& camera, unsigned classes);

    /// Its buffers, by label.
    static BufferSizes plan(const shared::Camera& camera, unsigned classes);
    /// Has the runtime compile the kernels.
    void compile();

    /// How many coarse passes the radii of `pass` are chosen from.
    static unsigned coarsePassesBefore(unsigned pass);
    /// So many coarse passes have ended.
    unsigned coarsePasses() const { return passes_; }
    /// Is the next coarse pass due with this one: is the bias of coarse pixels to be estimated, at the largest radius,
    /// with its photons?
    bool coarsePassIsDue(unsigned pass) const { return film_ && passes_ == pass; }
    const shared::Camera& camera() const { return camera_; }
    Film& coarseFilm() { return *film_; }
    const Buffer<float>& coarseScales() const { return coarseScales_; }
    /// To be called when the coarse film has taken its next pass. Chooses the radii anew after 2, 4, 8 and 16, and ends
    /// coarse passes.
    void endCoarsePass();

    /// Have all radii been chosen?
    bool coarsePassesHaveEnded() const { return !film_; }

    /// Radius of each block in a pass by that of the map, radiusIndex() in kernels/adaptive_radius.clh; 1 in the first
    /// passes. The coarse passes before it must have ended.
    const Buffer<float>& scales(unsigned pass) const;
    /// The radii chosen so far, and what those to come are chosen from.
    void save(StateSink& sink) const;
    void restore(const StateSource& source);

    /// Pixels of a row and column that share a radius.
    unsigned block() const { return block_; }

private:
    void endCoarsePasses();

    unsigned block_;
    shared::Camera camera_;
    std::optional<Film> film_; ///< until coarse passes have ended
    Kernel measureRadii_, chooseRadii_;
    std::vector<Buffer<float>> scales_; ///< as chosen: not at all, the first time, …
    Buffer<float> coarseScales_;
    Buffer<shared::RadiusMeasure> measures_;
    unsigned passes_ = 0;
    double squaredShrinks_ = 0, inverseShrinks_ = 0; ///< shared::RadiusParams
};

} // namespace quasilux
