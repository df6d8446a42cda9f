#include "auto/combination.h"

#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

using Layer = std::vector<float>;

class Sum {
public:
    Sum(const std::vector<FilmImage>& images, const std::vector<double>& weights)
        : images_(images), weights_(weights) {}

    /// `layer` gives a layer of an image; an empty one is zero. Empty if all are.
    template <typename GetLayer>
    Layer mean(const GetLayer& layer) const {
        return sum(
            layer, [](double weight, double value) { return weight * value; }, [](double v) { return v; });
    }
    /// Of independent images.
    template <typename GetLayer>
    Layer error(const GetLayer& layer) const {
        const auto square = [](double weight, double value) { return weight * weight * value * value; };
        return sum(layer, square, [](double v) { return std::sqrt(v); });
    }

private:
    template <typename GetLayer, typename Term, typename Finish>
    Layer sum(const GetLayer& layer, const Term& term, const Finish& finish) const {
        std::vector<double> total;
        for (size_t i = 0; i < images_.size(); ++i) {
            const Layer& values = layer(images_[i]);
            if (weights_[i] <= 0 || values.empty()) continue;
            total.resize(values.size());
            for (size_t k = 0; k < values.size(); ++k) total[k] += term(weights_[i], values[k]);
        }
        Layer result(total.size());
        for (size_t k = 0; k < total.size(); ++k) result[k] = static_cast<float>(finish(total[k]));
        return result;
    }

    const std::vector<FilmImage>& images_;
    const std::vector<double>& weights_;
};

void combineBias(const Sum& sum, FilmImage& combined) {
    combined.bias = sum.mean([](const FilmImage& i) -> const Layer& { return i.bias; });
    combined.biasError = sum.error([](const FilmImage& i) -> const Layer& { return i.biasError; });
    for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
        combined.componentBias[c] = sum.mean([c](const FilmImage& i) -> const Layer& { return i.componentBias[c]; });
        combined.componentBiasError[c] =
            sum.error([c](const FilmImage& i) -> const Layer& { return i.componentBiasError[c]; });
    }
}

} // namespace

std::vector<double> combinationWeights(const std::vector<Part>& parts) {
    std::vector<double> weights(parts.size());
    const auto normalise = [&] {
        double total = 0;
        for (const double weight : weights) total += weight;
        if (total > 0)
            for (double& weight : weights) weight /= total;
        return total > 0;
    };
    const auto inverse = [](double error) { return std::isfinite(error) && error > 0 ? 1 / error : 0; };
    for (size_t i = 0; i < weights.size(); ++i) {
        weights[i] = inverse(parts[i].relativeMse);
        const double ofLast = inverse(parts.back().relativeMse);
        if (ofLast > 0) weights[i] = std::min(weights[i], parts[i].seconds / parts.back().seconds * ofLast);
    }
    if (!normalise()) {
        if (!weights.empty()) weights.back() = 1;
        return weights;
    }
    for (double& weight : weights)
        if (weight < leastWeight) weight = 0;
    normalise();
    return weights;
}

FilmImage combineImages(const std::vector<FilmImage>& images, const std::vector<double>& weights) {
    if (images.empty() || images.size() != weights.size())
        throw std::invalid_argument("combineImages: expected as many weights as images, and at least one");
    if (images.size() == 1) return images.front();
    FilmImage combined;
    combined.width = images.front().width;
    combined.height = images.front().height;
    bool bias = true;
    for (size_t i = 0; i < images.size(); ++i) {
        if (images[i].width != combined.width || images[i].height != combined.height)
            throw std::invalid_argument("images of different sizes cannot be combined");
        if (weights[i] <= 0) continue;
        combined.passes += images[i].passes;
        bias = bias && !images[i].bias.empty();
    }
    const Sum sum(images, weights);
    combined.radiance = sum.mean([](const FilmImage& i) -> const Layer& { return i.radiance; });
    combined.standardError = sum.error([](const FilmImage& i) -> const Layer& { return i.standardError; });
    for (size_t c = 0; c < FILM_COMPONENTS; ++c)
        combined.components[c] = sum.mean([c](const FilmImage& i) -> const Layer& { return i.components[c]; });
    for (size_t c = 0; c < LIGHT_CLASSES; ++c)
        combined.componentError[c] = sum.error([c](const FilmImage& i) -> const Layer& { return i.componentError[c]; });
    if (bias) combineBias(sum, combined);
    return combined;
}

std::vector<double> weightsByError(const std::vector<FilmImage>& images, const std::vector<double>& seconds) {
    std::vector<Part> parts;
    for (size_t i = 0; i < images.size(); ++i) parts.push_back({estimateError(images[i]).relativeMse(), seconds.at(i)});
    return combinationWeights(parts);
}

} // namespace quasilux
