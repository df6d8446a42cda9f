// Images of several settings as one: all have the same mean, so any weights do that do not depend on the pixel.
#pragma once

#include "render/film_image.h"

#include <vector>

namespace quasilux {

/// Images with less of the whole than this are left out.
inline constexpr double leastWeight = 1e-3;

/// An image of some of the passes, and what its own passes tell of its error.
struct Part {
    double relativeMse = 0;
    double seconds = 0; ///< that its passes took
};

/// Weights that sum to 1, inverse to relMSE: one number for a whole image, since weights by the pixel's own variance
/// would favour dark estimates and darken the mean. The last part is of the settings chosen: the others were not found better
/// for their time, so none of them weighs more for its time than the last one does, however little error its few passes
/// happened to tell. 0 where the error is not known (not finite) or the weight would be below `leastWeight`. If no
/// error is known the last part has all the weight.
std::vector<double> combinationWeights(const std::vector<Part>& parts);

/// Sum of the images times their weights; standard errors and bias of that sum. Passes are those of images of weight
/// above 0. Sizes must agree. Where one of these has no estimate of the bias, the sum has none.
FilmImage combineImages(const std::vector<FilmImage>& images, const std::vector<double>& weights);

/// combinationWeights by each image's own estimate of its error; `seconds` as Part has them.
std::vector<double> weightsByError(const std::vector<FilmImage>& images, const std::vector<double>& seconds);

} // namespace quasilux
