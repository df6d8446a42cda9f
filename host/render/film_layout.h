// The floats of a pixel in the film (kernels/film.clh): compensated sums of the components, of the total's squares, of the squares of
// each class of light; plain sums of the open batch, of the total and by class; with an estimate of the bias plain sums of it, of its
// squares and of the open batch by class, then of squares and open batch of its total.
#pragma once

#include "pass_types.h"

#include <cstddef>

namespace quasilux::filmLayout {

inline constexpr size_t sumFloats = 6; ///< high, then low of R, G, B
inline constexpr size_t totalSquares = FILM_COMPONENTS * sumFloats;
inline constexpr size_t classSquares = totalSquares + sumFloats;
inline constexpr size_t totalBatch = classSquares + LIGHT_CLASSES * sumFloats;
inline constexpr size_t classBatch = totalBatch + 3;
inline constexpr size_t biasSums = classBatch + LIGHT_CLASSES * 3;
inline constexpr size_t biasClassFloats = 9; ///< sums, squares, open batch
inline constexpr size_t biasFloats = LIGHT_CLASSES * biasClassFloats + 6;

/// The value of a compensated sum.
inline double valueOf(const float* sum, size_t channel) { return double(sum[channel]) + sum[channel + 3]; }

constexpr size_t floatsPerPixel(bool estimatesBias) { return biasSums + (estimatesBias ? biasFloats : 0); }

} // namespace quasilux::filmLayout
