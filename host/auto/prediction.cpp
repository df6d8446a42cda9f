#include "auto/prediction.h"

#include "render/radius.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasilux {

namespace {

constexpr unsigned tilesPerSide = 8;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Radii fall smoothly, so far on sums over passes may take several at once: as many as this, by the radius of the middle one.
double passesAtOnce(double done) { return std::max(1.0, std::floor(done / 64)); }
unsigned middleOf(double done, double step) { return static_cast<unsigned>(done + (step - 1) / 2); }

// Mean over the first `passes` passes of (r_i / r_0)^2, in volumes too.
double meanSquaredRadius(double passes, bool inVolume) {
    const double last = std::max(1.0, passes);
    double total = 0, done = 0;
    while (done < last) {
        const double step = std::min(last - done, passesAtOnce(done));
        const unsigned middle = middleOf(done, step);
        const double shrink = inVolume ? volumeShrink(middle) : radiusShrink(middle);
        total += step * shrink * shrink;
        done += step;
    }
    return total / last;
}

// Bias goes as this power of the radius. Of smooth light it is 2, of a slope's break 1.5 (root of the mean square), of an
// edge 0.5; true bias of renders falls as its power 0.9 to 1.6 (docs/auto.md).
constexpr double biasByRadius = 1.4;

// Factors on noise and bias of a pilot after `passes` passes.
struct Growth {
    double noise, bias;
};

Growth growthTo(const PilotMeasure& pilot, double passes) {
    const double blur = meanSquaredRadius(passes, pilot.inVolume) / meanSquaredRadius(pilot.passes, pilot.inVolume);
    return {pilot.passes / passes, std::pow(blur, biasByRadius)}; // blur: radius squared, bias: of relMSE, squared
}

// Passes grow cheaper as radii shrink.
double passesAfter(const PilotMeasure& pilot, double seconds) {
    double passes = pilot.passes, left = std::max(0.0, seconds);
    const double toldBy = radiusShrink(pilot.passes * 3 / 4), even = pilot.secondsPerPass - pilot.secondsWithRadius;
    while (true) {
        const double step = passesAtOnce(passes);
        const double shrink = radiusShrink(middleOf(passes, step)) / toldBy;
        const double cost = std::max(even + shrink * shrink * pilot.secondsWithRadius, 1e-9);
        if (left <= step * cost) return passes + left / cost;
        passes += step;
        left -= step * cost;
    }
}

// Below this share of its noise the bias of an image of many pixels cannot be told from 0 (docs/accuracy.md).
constexpr double resolvedBias = 1.0 / 25;

// The bias that cannot be told from 0: of small images it is more, as their tiles scatter. What is less counts as so much:
// taken for what it is told, a candidate would win for knowing less about its bias.
double leastBias(const PilotMeasure& pilot) {
    const double n = static_cast<double>(pilot.bias.size()), mean = sum(pilot.bias) / std::max(1.0, n);
    double squares = 0;
    for (const double bias : pilot.bias) squares += (bias - mean) * (bias - mean);
    return std::max(resolvedBias * pilot.biasNoise, std::sqrt(n / std::max(1.0, n - 1) * squares));
}

struct Estimate {
    double value = 0, standardError = 0;

    // What cannot be told from 0 counts as much as it may be.
    double counted() const { return std::max(value, standardError); }
};

Estimate biasOf(const PilotMeasure& pilot) { return {sum(pilot.bias), leastBias(pilot)}; }

// Mean of two estimates of one thing, weights inverse to their variance.
Estimate pooled(const Estimate& a, const Estimate& b) {
    const double weightA = 1 / (a.standardError * a.standardError), weightB = 1 / (b.standardError * b.standardError);
    return {(weightA * a.value + weightB * b.value) / (weightA + weightB), 1 / std::sqrt(weightA + weightB)};
}

Estimate between(const Estimate& a, const Estimate& b, double shareOfB) {
    return {(1 - shareOfB) * a.value + shareOfB * b.value,
            (1 - shareOfB) * a.standardError + shareOfB * b.standardError};
}

// One of two that are compared, as it will be at the end.
struct Side {
    const PilotMeasure& pilot;
    Growth growth;
    Estimate bias;

    // Without the noise and bias of a tile.
    double error(double noiseLeftOut, double biasLeftOut) const {
        const double noise = sum(pilot.noise), least = 1e-12 * growth.noise * noise; // a tile may hold all of it
        const Estimate left{bias.value - biasLeftOut, bias.standardError};
        return std::max(least, growth.noise * (noise - noiseLeftOut) + growth.bias * left.counted()) + 1e-300;
    }
    // Standard error of error() by that of the bias.
    double byBias() const { return growth.bias * bias.standardError; }
    double hiddenBias() const { return bias.value < bias.standardError ? byBias() : 0; }
};

// Biases of two are taken to be one, but for what their radii explain, as far as noise explains their difference d of
// standard error s: each keeps the share 1 - s^2 / d^2 of its distance from the mean of both (James & Stein 1961), which
// is returned.
double shrinkBias(Side& a, Side& b) {
    const double byRadius = std::pow(a.pilot.radius / b.pilot.radius, 2 * biasByRadius);
    const Estimate ofB{byRadius * b.bias.value, byRadius * b.bias.standardError};
    if (a.bias.standardError == 0 || ofB.standardError == 0) return 1;
    const double apart = (a.bias.value - ofB.value) / std::hypot(a.bias.standardError, ofB.standardError);
    const double own = std::max(0.0, 1 - 1 / (apart * apart));
    const Estimate mean = pooled(a.bias, ofB);
    a.bias = between(mean, a.bias, own);
    b.bias = between({mean.value / byRadius, mean.standardError / byRadius}, b.bias, own);
    return own;
}

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

bool tellsBias(const PilotMeasure& pilot) {
    constexpr double surely = 2; // standard errors
    const Estimate bias = biasOf(pilot);
    return bias.value > surely * bias.standardError;
}

double Prediction::relativeError() const { return std::sqrt(relativeMse()); }

Prediction predictAfterPasses(const PilotMeasure& pilot, double passes) {
    const Growth growth = growthTo(pilot, passes);
    return {passes, growth.noise * sum(pilot.noise), growth.bias * biasOf(pilot).counted()};
}

Prediction predictAfter(const PilotMeasure& pilot, double seconds) {
    return predictAfterPasses(pilot, passesAfter(pilot, seconds));
}

ErrorRatio errorRatio(const PilotMeasure& a, const PilotMeasure& b, double seconds) {
    Side sideA{a, growthTo(a, passesAfter(a, seconds)), biasOf(a)};
    Side sideB{b, growthTo(b, passesAfter(b, seconds)), biasOf(b)};
    const double own = shrinkBias(sideA, sideB);
    const double errorA = sideA.error(0, 0), errorB = sideB.error(0, 0);
    ErrorRatio result;
    result.logRatio = std::log(errorA / errorB);
    const size_t tiles = std::min(a.noise.size(), b.noise.size());
    double mean = 0, squares = 0;
    for (size_t t = 0; t < tiles; ++t) {
        const double left =
            std::log(sideA.error(a.noise[t], own * a.bias[t]) / sideB.error(b.noise[t], own * b.bias[t]));
        mean += left;
        squares += left * left;
    }
    const double n = static_cast<double>(tiles);
    mean /= std::max(1.0, n);
    if (tiles > 1) result.standardError = std::sqrt((n - 1) / n * std::max(0.0, squares - n * mean * mean));
    // What noise may hide of the common bias moves both; of a bias that counts as the least, tiles do not tell it.
    const double ofCommon = sideA.byBias() / errorA - sideB.byBias() / errorB;
    const double ofOwn = std::hypot(sideA.hiddenBias() / errorA, sideB.hiddenBias() / errorB);
    const double hidden = (1 - own) * std::abs(ofCommon) + own * ofOwn;
    result.standardError = std::hypot(result.standardError, hidden);
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
