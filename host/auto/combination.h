// Images of several settings as one: every one of them has the same mean, so any weights do that do not depend on the pixel.
#pragma once

#include "render/film_image.h"

#include <vector>

namespace quasilux {

/// Images with less of the whole than this are left out.
inline constexpr double leastWeight = 1e-3;

/// Weights that sum to 1, inverse to relMSE: one number for a whole image, since weights by the pixel's own variance would
/// favour dark estimates and darken the mean. 0 where the error is not known (not finite) or the weight would be below
/// `leastWeight`. If no error is known the last image has all the weight.
std::vector<double> combinationWeights(const std::vector<double>& relativeMse);

/// Sum of the images times their weights; standard errors and bias of that sum. Passes are those of images of weight
/// above 0. Sizes must agree. Where one of these has no estimate of the bias, the sum has none.
FilmImage combineImages(const std::vector<FilmImage>& images, const std::vector<double>& weights);

/// combinationWeights by each image's own estimate of its error.
std::vector<double> weightsByError(const std::vector<FilmImage>& images);

} // namespace quasilux
