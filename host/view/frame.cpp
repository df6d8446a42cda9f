#include "view/frame.h"

#include "util/error.h"
#include "util/nearest.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quasilux {

namespace {

constexpr unsigned mostPixels = 1u << 21;      // of a frame
constexpr unsigned mostThinned = 1u << 19;     // of one of a film that is thinned, while the render goes on
constexpr size_t pixelsForExposure = 1u << 14; // looked at for the automatic exposure
constexpr float largestHalf = 65504;

const std::string imageLayer = "image", noiseLayer = "stderr", biasLayer = "bias", ratioLayer = "relative_error";

// As many pixels of the film as may be read.
unsigned samplingOf(const FilmCutChoice& choice, std::optional<size_t> mostRead) {
    const size_t all = size_t{choice.width} * choice.height;
    if (!mostRead || all <= *mostRead) return CUT_ALL;
    return all / choice.step <= *mostRead ? CUT_DIAGONAL : CUT_MIDDLE;
}

// Of the component with this name; FILM_COMPONENTS: it is none.
unsigned componentOf(const std::string& layer) {
    unsigned component = 0;
    while (component < FILM_COMPONENTS && componentName(component) != layer) ++component;
    return component;
}

ToneCurve curveOf(const FilmImage& cut) {
    const size_t pixels = cut.radiance.size() / 3, stride = pixels / pixelsForExposure + 1;
    FilmImage some;
    for (size_t k = 0; k < pixels; k += stride)
        some.radiance.insert(some.radiance.end(), &cut.radiance[3 * k], &cut.radiance[3 * k] + 3);
    return chooseToneCurve(some, {});
}

double meanOf(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Calls `figure(value, error)` of each channel and sums by pixel.
template <typename Figure>
std::vector<float> byPixel(const std::vector<float>& values, const std::vector<float>& errors, const Figure& figure) {
    std::vector<float> sums(values.size() / 3);
    for (size_t k = 0; k < errors.size(); ++k) sums[k / 3] += static_cast<float>(figure(values[k], errors[k])) / 3;
    return sums;
}

std::vector<float> figuresOf(const std::string& layer, const FilmImage& cut, double mean) {
    const double dark = 0.01 * mean * mean;
    const auto scaleOf = [&](double value) { return value * value + dark > 0 ? value * value + dark : 1; };
    if (layer == biasLayer)
        return byPixel(cut.radiance, cut.bias, [&](double v, double bias) { return bias / std::sqrt(scaleOf(v)); });
    const bool isRatio = layer == ratioLayer;
    auto squares = byPixel(cut.radiance, cut.standardError,
                           [&](double v, double error) { return error * error / (isRatio ? scaleOf(v) : 1); });
    for (float& square : squares) square = std::sqrt(square);
    return squares;
}

} // namespace

std::vector<std::string> layersOf(const FilmLayout& film) {
    std::vector<std::string> layers{imageLayer};
    for (unsigned c = 0; film.components && c < FILM_COMPONENTS; ++c) layers.push_back(componentName(c));
    layers.push_back(noiseLayer);
    if (film.bias) layers.push_back(biasLayer);
    layers.push_back(ratioLayer);
    return layers;
}

bool isValueLayer(const std::string& layer) { return layer == imageLayer || componentOf(layer) < FILM_COMPONENTS; }

FilmCutChoice cutFor(const FrameWish& wish, const Film& film, std::optional<size_t> mostRead) {
    const auto layers = layersOf(film.layout());
    if (std::find(layers.begin(), layers.end(), wish.layer) == layers.end())
        throw InputError("layer '" + wish.layer + "' is not there, " + expectedNames(wish.layer, layers));
    FilmCutChoice choice;
    choice.x = std::min(wish.x, film.width() - 1);
    choice.y = std::min(wish.y, film.height() - 1);
    choice.width = std::clamp(wish.width, 1u, film.width() - choice.x);
    choice.height = std::clamp(wish.height, 1u, film.height() - choice.y);
    choice.step = std::clamp(wish.step, 1u, std::max(choice.width, choice.height));
    const auto exceeds = [&](size_t most) {
        return size_t{choice.width / choice.step} * (choice.height / choice.step) > most;
    };
    const size_t mostOfThinned = std::min<size_t>(mostThinned, mostRead.value_or(mostPixels));
    while (exceeds(mostPixels) || (mostRead && choice.step > 1 && exceeds(mostOfThinned))) ++choice.step;
    const unsigned component = componentOf(wish.layer);
    if (component < FILM_COMPONENTS) choice.component = component;
    const bool isValue = isValueLayer(wish.layer);
    if (!isValue) choice.content = FilmCutChoice::Content::errors;
    choice.sampling = isValue ? samplingOf(choice, mostRead) : CUT_MIDDLE;
    return choice;
}

size_t pixelsRead(const FilmCutChoice& choice) {
    const size_t all = size_t{choice.width} * choice.height, step = choice.step;
    return choice.sampling == CUT_ALL ? all : choice.sampling == CUT_DIAGONAL ? all / step : all / (step * step);
}

Frame makeFrame(const FrameWish& wish, const FilmCutChoice& choice, const FilmImage& cut, double mean) {
    Frame frame;
    frame.x = choice.x;
    frame.y = choice.y;
    frame.step = choice.step;
    frame.width = cut.width;
    frame.height = cut.height;
    frame.passes = cut.passes;
    frame.curve = curveOf(cut);
    frame.meanRadiance = meanOf(cut.radiance);
    const bool isFigure = choice.content != FilmCutChoice::Content::values;
    frame.channels = isFigure ? 1 : 3;
    frame.isKnown = !isFigure || wish.layer == biasLayer || cut.isErrorKnown();
    // A power of two, so that it changes no digit.
    if (!isFigure || wish.layer == noiseLayer) frame.scale = std::exp2(std::round(std::log2(frame.curve.scale)));
    const auto values = isFigure ? figuresOf(wish.layer, cut, mean > 0 ? mean : frame.meanRadiance) : cut.radiance;
    frame.halves.resize(values.size());
    for (size_t k = 0; k < values.size(); ++k) frame.halves[k] = toHalf(static_cast<float>(frame.scale * values[k]));
    return frame;
}

uint16_t toHalf(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = bits >> 16 & 0x8000u;
    const float size = std::abs(value);
    if (!(size < largestHalf)) return static_cast<uint16_t>(sign | (std::isnan(value) ? 0x7e00u : 0x7bffu));
    if (size < 0x1p-14f) // subnormal: a multiple of 2^-24
        return static_cast<uint16_t>(sign | static_cast<uint32_t>(std::nearbyint(size * 0x1p24f)));
    const uint32_t magnitude = bits & 0x7fffffffu, odd = magnitude >> 13 & 1u;
    return static_cast<uint16_t>(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
}

} // namespace quasilux
