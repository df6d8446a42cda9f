#include "auto/prediction.h"

#include "render/radius.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasilux {

namespace {

constexpr unsigned tilesPerSide = 8;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Radii fall smoothly, so far on sums over passes may take several at once: as many as this, by the radius of the
// middle one.
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

// Bias goes as this power of the radius. Of smooth light it is 2, of a slope's break 1.5 (root of the mean square), of
// an edge 0.5; true bias of renders falls as its power 0.9 to 1.6 (docs/method/auto.md).
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
    const double measuredShrink = radiusShrink(pilot.passes * 3 / 4),
                 even = pilot.secondsPerPass - pilot.secondsWithRadius;
    while (true) {
        const double step = passesAtOnce(passes);
        const double shrink = radiusShrink(middleOf(passes, step)) / measuredShrink;
        const double cost = std::max(even + shrink * shrink * pilot.secondsWithRadius, 1e-9);
        if (left <= step * cost) return passes + left / cost;
        passes += step;
        left -= step * cost;
    }
}

// Below this share of its noise the bias of an image of many pixels cannot be distinguished from 0
// (docs/method/accuracy.md).
constexpr double resolvedBias = 1.0 / 25;

// The bias that cannot be distinguished from 0: of small images it is more, as their tiles scatter. What is less counts
// as so much: taken as estimated, a candidate would win for knowing less about its bias.
double leastBias(const PilotMeasure& pilot) {
    const double n = static_cast<double>(pilot.bias.size()), mean = sum(pilot.bias) / std::max(1.0, n);
    double squares = 0;
    for (const double bias : pilot.bias) squares += (bias - mean) * (bias - mean);
    return std::max(resolvedBias * pilot.biasNoise, std::sqrt(n / std::max(1.0, n - 1) * squares));
}

struct Estimate {
    double value = 0, standardError = 0;

    // What cannot be distinguished from 0 counts as much as it may be.
    double counted() const { return std::max(value, standardError); }
};

Estimate biasOf(const PilotMeasure& pilot) { return {sum(pilot.bias), leastBias(pilot)}; }

// Several estimates of one thing, or of things that differ by `spread` (a variance) as far as their noise does not
// explain it (DerSimonian & Laird 1986).
struct Common {
    double mean = 0, standardError = 0, spread = 0;

    explicit Common(const std::vector<Estimate>& estimates) {
        double weights = 0, squaredWeights = 0, squares = 0;
        for (const auto& e : estimates) {
            const double weight = 1 / (e.standardError * e.standardError);
            weights += weight;
            squaredWeights += weight * weight;
            mean += weight * e.value;
        }
        mean /= weights;
        standardError = 1 / std::sqrt(weights);
        for (const auto& e : estimates) squares += std::pow((e.value - mean) / e.standardError, 2);
        const double free = static_cast<double>(estimates.size()) - 1;
        if (free > 0) spread = std::max(0.0, (squares - free) / (weights - squaredWeights / weights));
    }

    // The estimate, drawn to the mean by as much of its distance as is noise.
    Estimate shrunk(const Estimate& e) const {
        const double variance = e.standardError * e.standardError, own = spread / (spread + variance);
        return {mean + own * (e.value - mean), standardError + own * (e.standardError - standardError)};
    }
};

// Fewer passes than this do not know their error well. Where one camera path leaves fewer, more paths leave half of
// these, but never less than the last.
constexpr double fewestPassesOfImage = 32, fewestPassesOfAny = 8;

// A few passes know nothing of light that paths seldom meet, and camera paths that gather nothing are cheap: for so
// much of what the photons of a pass cost there are always some.
constexpr double shareOfUnseen = 0.25;

// Variance of a mean of n camera paths of a pass goes as this power of n: -1 of paths that know nothing of each other,
// and what is gained by nets, which are larger then (kernels/lattice.clh): the variance of one path on them falls to
// 0.3 to 0.75 of that of a single one with 16, a half in the mean of ten scenes. That of caustics that paths find stays
// as it is: 0.8 to 1.25 with 64.
constexpr double noiseByPaths = -1.25;

// Share of the total noise that components from `first` to before `end` have; all of it where the film keeps none.
double shareOfNoise(unsigned first, unsigned end, const ErrorEstimate& error, bool hasComponents) {
    if (!hasComponents) return 1;
    double part = 0;
    for (unsigned c = first; c < end; ++c) part += error.components[c].noiseRms * error.components[c].noiseRms;
    const double total = error.total.noiseRms * error.total.noiseRms;
    return total > 0 ? std::min(1.0, part / total) : 1;
}

// The square of their sum over its variance; pixels are independent where paths meet them.
double causticsMet(const FilmImage& image) {
    double light = 0, variance = 0;
    const RadianceEstimate& caustics = image.components[LIGHT_CAUSTIC];
    for (const float value : caustics.radiance) light += value;
    for (const float error : caustics.standardError) variance += double(error) * error;
    return variance > 0 ? light * light / variance : 0;
}

// Biases of radius 1.
std::vector<Estimate> biasesOf(const std::vector<PilotMeasure>& pilots) {
    std::vector<Estimate> biases;
    bool allKnown = true;
    for (const auto& pilot : pilots) {
        const double ofRadius = std::pow(pilot.radius, 2 * biasByRadius);
        const Estimate bias = biasOf(pilot);
        biases.push_back({bias.value / ofRadius, bias.standardError / ofRadius});
        allKnown &= bias.standardError > 0;
    }
    if (!allKnown) return biases;
    const Common common(biases);
    for (auto& bias : biases) bias = common.shrunk(bias);
    return biases;
}

} // namespace

PilotMeasure measurePilot(const FilmImage& image, bool hasMedia, double secondsPerPass,
                          const std::vector<float>& brightness, double radiance) {
    const ErrorEstimate error = estimateError(image);
    const TileErrors tiles = errorByTile(image, tilesPerSide, brightness);
    PilotMeasure pilot;
    pilot.passes = image.passes;
    // Classes of light that photons carry have noise of camera paths too, which counts as the photons' here.
    pilot.noiseOfPhotons = shareOfNoise(LIGHT_DIRECT + 1, LIGHT_CLASSES, error, image.hasComponents());
    pilot.noiseOfCaustics = shareOfNoise(LIGHT_CAUSTIC, LIGHT_CAUSTIC + 1, error, image.hasComponents());
    pilot.causticsByPaths = noiseOfFinding(image, LIGHT_CAUSTIC, radiance, brightness);
    pilot.causticsMet = causticsMet(image);
    pilot.secondsPerPass = secondsPerPass;
    pilot.noise = tiles.noise;
    pilot.bias = tiles.bias;
    pilot.biasNoise = error.total.biasNoiseRms * error.total.biasNoiseRms;
    pilot.inVolume = hasMedia;
    return pilot;
}

void Brightness::add(const std::vector<float>& radiance, const PilotMeasure& pilot) {
    const double noise = sum(pilot.noise);
    if (!(noise > 0)) return;
    sum_.resize(radiance.size());
    for (size_t k = 0; k < radiance.size(); ++k) sum_[k] += radiance[k] / noise;
    weight_ += 1 / noise;
}

std::vector<float> Brightness::mean() const {
    std::vector<float> mean(sum_.size());
    for (size_t k = 0; k < mean.size(); ++k) mean[k] = static_cast<float>(sum_[k] / weight_);
    return mean;
}

double Prediction::relativeError() const { return std::sqrt(relativeMse()); }

Prediction predictAfterPasses(const PilotMeasure& pilot, double passes) {
    const Growth growth = growthTo(pilot, passes);
    return {passes, growth.noise * sum(pilot.noise), growth.bias * biasOf(pilot).counted()};
}

Prediction predictAfter(const PilotMeasure& pilot, double seconds) {
    return predictAfterPasses(pilot, passesAfter(pilot, seconds));
}

Prediction predictAnew(const PilotMeasure& pilot, double seconds) {
    return predictAfterPasses(pilot, std::max(1.0, passesAfter(pilot, seconds) - pilot.passes));
}

std::vector<double> predictedErrors(const std::vector<PilotMeasure>& pilots, double seconds) {
    const auto biases = biasesOf(pilots);
    std::vector<double> errors;
    for (size_t k = 0; k < pilots.size(); ++k) {
        const PilotMeasure& pilot = pilots[k];
        const Growth growth = growthTo(pilot, passesAfter(pilot, seconds));
        const double ofRadius = std::pow(pilot.radius, 2 * biasByRadius);
        errors.push_back(growth.noise * sum(pilot.noise) + growth.bias * ofRadius * biases[k].counted());
    }
    return errors;
}

PilotMeasure withCameraPaths(PilotMeasure pilot, double factor) {
    const double ofCamera = pilot.secondsPerPass - pilot.secondsOfPhotons;
    const double found = pilot.findsCaustics ? pilot.noiseOfCaustics : 0, rest = 1 - pilot.noiseOfPhotons - found;
    const double noise = pilot.noiseOfPhotons + found / factor + rest * std::pow(factor, noiseByPaths);
    pilot.secondsPerPass = pilot.secondsOfPhotons + factor * ofCamera;
    for (double& ofTile : pilot.noise) ofTile *= noise;
    pilot.noiseOfPhotons /= noise;
    pilot.noiseOfCaustics /= pilot.findsCaustics ? factor * noise : noise;
    return pilot;
}

double gainOfSampling(const PilotMeasure& pilot, const SamplingGain& gain) {
    const double noise = pilot.noiseOfPhotons + (1 - pilot.noiseOfPhotons) / gain.variance;
    const double ofCamera = pilot.secondsPerPass - pilot.secondsOfPhotons;
    const double seconds = pilot.secondsOfPhotons + gain.time * ofCamera;
    return pilot.secondsPerPass / (noise * seconds);
}

PilotMeasure withRareCaustics(PilotMeasure pilot, double noiseOfOnePath, unsigned cameraPaths) {
    const double all = sum(pilot.noise), seen = pilot.noiseOfCaustics * all,
                 before = noiseOfOnePath / (double(pilot.passes) * cameraPaths);
    const double caustics = (pilot.causticsMet * seen + before) / (pilot.causticsMet + 1);
    const double counted = all - seen + caustics;
    if (!(all > 0)) return pilot;
    for (double& ofTile : pilot.noise) ofTile *= counted / all;
    pilot.noiseOfCaustics = caustics / counted;
    return pilot;
}

unsigned bestCameraPaths(const PilotMeasure& pilot, unsigned cameraPaths, double seconds) {
    const double ofOnePath = (pilot.secondsPerPass - pilot.secondsOfPhotons) / cameraPaths;
    const auto tooFew = [&](unsigned paths) { return 2 * paths * ofOnePath <= shareOfUnseen * pilot.secondsOfPhotons; };
    unsigned best = 1;
    double least = INFINITY, fewest = 0;
    for (unsigned paths = 1; paths <= mostCameraPaths; paths *= 2) {
        const PilotMeasure changed = withCameraPaths(pilot, double(paths) / cameraPaths);
        const Prediction predicted = predictAnew(changed, seconds);
        if (paths == 1)
            fewest = std::clamp(predicted.passes / 2, fewestPassesOfAny, fewestPassesOfImage);
        else if (predicted.passes < fewest)
            break;
        if (predicted.relativeMse() < least || tooFew(best)) {
            least = predicted.relativeMse();
            best = paths;
        }
    }
    return best;
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
