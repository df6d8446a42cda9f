// Sums of different passes as those of all of them.
#pragma once

#include "render/film.h"

namespace quasilux {

/// Adds the sums of other passes of the same image, pixel by pixel from `first` on, to `sums`. Each film's open batch
/// of passes is complete then (FilmCounts::close).
void mergeFilmSums(float* sums, const FilmCounts& counts, const float* others, const FilmCounts& otherCounts,
                   size_t pixels, const FilmLayout& layout);

/// Completes the batch of passes that is open, as mergeFilmSums does. Its counts are FilmCounts::closed() then.
void closeBatches(float* sums, const FilmCounts& counts, size_t pixels, const FilmLayout& layout);

/// The counts of both, after mergeFilmSums.
FilmCounts mergedCounts(const FilmCounts& a, const FilmCounts& b);

} // namespace quasilux
