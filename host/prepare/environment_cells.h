// The cells by which directions to an image of the surroundings are sampled (kernels/emitters/envmap.clh).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Cells by latitude and longitude, with weights at their corners: the density of directions is bilinear in a cell.
class EnvironmentCells {
public:
    /// The cells between the image's pixels, or, where that costs samples hardly any variance, so few larger ones that
    /// their tables stay in the cache of a CPU's core. A look-up in tables of megabytes takes longer than a short ray.
    explicit EnvironmentCells(const EnvironmentImage& image);

    unsigned across() const { return across_; }
    unsigned down() const { return down_; }
    /// Of the corners of larger cells, `across` a row, `down` + 1 rows; none where cells are those between the pixels.
    const std::vector<float>& weights() const { return weights_; }
    /// At the corners of a row, but for the base.
    std::vector<float> weightsOfRow(unsigned row) const;
    /// Mean of the weights over the sphere.
    double meanWeight() const;

private:
    EnvironmentCells(const EnvironmentImage& image, unsigned down);
    /// E[(L / p)²] / E[L / p]² over the sphere, p proportional to the bilinear weights.
    double secondMoment() const;

    const EnvironmentImage* image_;
    unsigned across_, down_;
    std::vector<float> weights_;
};

} // namespace quasilux
