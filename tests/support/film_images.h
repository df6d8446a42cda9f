// Images as a render leaves them, made by hand.
#pragma once

#include "render/film_image.h"

namespace quasilux {

/// All pixels and channels alike, so are their standard errors.
inline FilmImage uniformImage(unsigned width, unsigned height, float value, unsigned passes, float standardError) {
    FilmImage image;
    image.width = width;
    image.height = height;
    image.passes = image.batches = passes;
    image.radiance.assign(size_t{width} * height * 3, value);
    image.standardError.assign(image.radiance.size(), standardError);
    return image;
}

} // namespace quasilux
