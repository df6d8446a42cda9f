#include "auto/prediction.h"

#include "render/radius.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasilux {

namespace {

constexpr unsigned tilesPerSide = 8;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Mean over the first `passes` passes of (r_i / r_0)^2, in volumes too. It falls smoothly, so far on steps grow.
double meanSquaredRadius(double passes, bool inVolume) {
    const double last = std::max(1.0, passes);
    double total = 0, done = 0;
    while (done < last) {
        const double step = std::min(last - done, std::max(1.0, std::floor(done / 64)));
        const auto middle = static_cast<unsigned>(done + (step - 1) / 2);
        const double shrink = inVolume ? volumeShrink(middle) : radiusShrink(middle);
        total += step * shrink * shrink;
        done += step;
    }
    return total / last;
}

// Factors on noise and bias of a pilot after `passes` passes.
struct Growth {
    double noise, bias;
};

Growth growthTo(const PilotMeasure& pilot, double passes) {
    const double blur = meanSquaredRadius(passes, pilot.inVolume) / meanSquaredRadius(pilot.passes, pilot.inVolume);
    return {pilot.passes / passes, blur * blur};
}

double passesAfter(const PilotMeasure& pilot, double seconds) {
    return pilot.passes + std::max(0.0, seconds) / std::max(pilot.secondsPerPass, 1e-9);
}

// Below this share of its noise a bias cannot be told from 0 (docs/accuracy.md). It counts as so much: taken for 0, a
// candidate would win for knowing less about its bias.
constexpr double resolvedBias = 1.0 / 25;

double resolved(double bias, double biasNoise) { return std::max(bias, resolvedBias * biasNoise); }

} // namespace

PilotMeasure measurePilot(const FilmImage& image, bool hasMedia, double secondsPerPass) {
    const ErrorEstimate error = estimateError(image);
    const TileErrors tiles = errorByTile(image, tilesPerSide);
    PilotMeasure pilot;
    pilot.passes = image.passes;
    pilot.secondsPerPass = secondsPerPass;
    pilot.noise = tiles.noise;
    pilot.bias = tiles.bias;
    pilot.biasNoise = error.total.biasNoiseRms * error.total.biasNoiseRms;
    pilot.inVolume = hasMedia;
    return pilot;
}

double Prediction::relativeError() const { return std::sqrt(relativeMse()); }

Prediction predictAfterPasses(const PilotMeasure& pilot, double passes) {
    const Growth growth = growthTo(pilot, passes);
    return {passes, growth.noise * sum(pilot.noise), growth.bias * resolved(sum(pilot.bias), pilot.biasNoise)};
}

Prediction predictAfter(const PilotMeasure& pilot, double seconds) {
    return predictAfterPasses(pilot, passesAfter(pilot, seconds));
}

ErrorRatio errorRatio(const PilotMeasure& a, const PilotMeasure& b, double seconds) {
    const Growth growthA = growthTo(a, passesAfter(a, seconds)), growthB = growthTo(b, passesAfter(b, seconds));
    const auto error = [](const PilotMeasure& pilot, const Growth& growth, double noise, double bias) {
        const double least = 1e-12 * growth.noise * sum(pilot.noise); // a tile may hold all of it
        return std::max(least, growth.noise * noise + growth.bias * resolved(bias, pilot.biasNoise)) + 1e-300;
    };
    const double noiseA = sum(a.noise), noiseB = sum(b.noise), biasA = sum(a.bias), biasB = sum(b.bias);
    ErrorRatio result;
    result.logRatio = std::log(error(a, growthA, noiseA, biasA) / error(b, growthB, noiseB, biasB));
    const size_t tiles = std::min(a.noise.size(), b.noise.size());
    double mean = 0, squares = 0;
    for (size_t t = 0; t < tiles; ++t) {
        const double left = std::log(error(a, growthA, noiseA - a.noise[t], biasA - a.bias[t]) /
                                     error(b, growthB, noiseB - b.noise[t], biasB - b.bias[t]));
        mean += left;
        squares += left * left;
    }
    const double n = static_cast<double>(tiles);
    mean /= std::max(1.0, n);
    if (tiles > 1) result.standardError = std::sqrt((n - 1) / n * std::max(0.0, squares - n * mean * mean));
    return result;
}

double secondsToError(const PilotMeasure& pilot, double relativeError, double limit) {
    const double target = relativeError * relativeError;
    if (predictAfter(pilot, limit).relativeMse() > target) return limit;
    double from = 0, to = limit;
    for (int step = 0; step < 60; ++step) {
        const double middle = (from + to) / 2;
        (predictAfter(pilot, middle).relativeMse() > target ? from : to) = middle;
    }
    return to;
}

} // namespace quasilux
