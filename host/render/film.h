// The film on the device (kernels/film.clh): sums over passes by pixel, and what they say of the image.
#pragma once

#include "device/buffer.h"
#include "pass_types.h"
#include "render/film_image.h"

namespace quasilux {

class Film {
public:
    Film(Device& device, unsigned width, unsigned height);

    /// Means over `passes` and their standard errors.
    FilmImage develop(unsigned passes) const;
    /// Samples dropped and paths cut since the beginning.
    shared::CameraCounters counters() const { return counters_.read().front(); }

    size_t pixels() const { return size_t(width_) * height_; }
    Buffer<float>& sums() { return sums_; }
    Buffer<shared::CameraCounters>& counterBuffer() { return counters_; }

private:
    unsigned width_, height_;
    Buffer<float> sums_;
    Buffer<shared::CameraCounters> counters_;
};

} // namespace quasilux
