// What passes have come to, away from the device: sums that add up in any order.
#pragma once

#include "render/film.h"
#include "render/renderer.h"

namespace quasilux {

struct PassSums {
    Renderer::FilmShape shape{};
    std::vector<float> film; ///< sums, all batches of passes complete; empty: no pass
    FilmCounts counts;
    RenderCounters counters;
    std::map<std::string, KernelTiming> timings;

    bool isEmpty() const { return film.empty(); }
    size_t pixels() const { return size_t(shape.width) * shape.height; }
    FilmImage develop() const;
    /// Film::save() of it.
    void save(StateSink& sink, const std::string& name) const;
};

/// Takes them off the renderer, which forgets its passes. Throws DeviceError where they cannot be read, or are not
/// finite.
PassSums takeSums(Device& device, Renderer& renderer);

/// Of all but films, which ranks of a job add on their way.
void addAllButFilm(PassSums& all, const PassSums& part);

/// Films are added to 48 bits (film_merge.h).
void add(PassSums& all, const PassSums& part);

} // namespace quasilux
