// The choice of settings by pilot passes (docs/auto.md): prediction, search, the mean of what is added.
//
// False alarms: the two means are held to 4 standard errors (6e-5 each); the seeds are fixed. The search itself runs on
// pilots made up here, whose errors and costs are known, by a clock that only their passes move.
#include "auto/auto_render.h"
#include "auto/combination.h"
#include "support/render_statistics.h"

#include "device/device.h"
#include "render/radius.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

using testing::HasSubstr;

constexpr size_t tiles = 64;

// --- prediction ---

PilotMeasure evenPilot(unsigned passes, double noisePerPass, double bias, double secondsPerPass) {
    PilotMeasure pilot;
    pilot.passes = passes;
    pilot.secondsPerPass = secondsPerPass;
    pilot.noise.assign(tiles, noisePerPass / passes / tiles);
    pilot.bias.assign(tiles, bias / tiles);
    return pilot;
}

TEST(Prediction, NoiseFallsWithPassesAndBiasWithTheMeanSquaredRadius) {
    const PilotMeasure pilot = evenPilot(4, 8, 0.5, 0.1);
    const auto meanSquare = [](unsigned passes) {
        double sum = 0;
        for (unsigned i = 0; i < passes; ++i) sum += radiusShrink(i) * radiusShrink(i);
        return sum / passes;
    };
    for (const unsigned passes : {4u, 40u, 400u}) {
        const Prediction predicted = predictAfterPasses(pilot, passes);
        EXPECT_NEAR(predicted.noise, 8.0 / passes, 1e-9);
        const double blur = meanSquare(passes) / meanSquare(4);
        EXPECT_NEAR(predicted.bias / (0.5 * blur * blur), 1, 0.005) << passes; // radii far on are taken in steps
    }
    EXPECT_NEAR(predictAfter(pilot, 1).passes, 14, 1e-9);
}

TEST(Prediction, TimeToAnErrorIsWhereThePredictionMeetsIt) {
    const PilotMeasure pilot = evenPilot(4, 1, 0, 0.5);
    const double seconds = secondsToError(pilot, 0.1, 1000); // 100 passes, 4 of them done
    EXPECT_NEAR(seconds, 48, 1e-6);
    EXPECT_EQ(secondsToError(pilot, 0.001, 1000), 1000);
}

// What is hard for both is no uncertainty of their ratio; a bright pixel of one of them is.
TEST(Prediction, RatioIsUncertainWhereOneTileHoldsTheNoiseOfOne) {
    PilotMeasure a = evenPilot(4, 1, 0, 1), b = evenPilot(4, 2, 0, 1);
    a.noise[0] = b.noise[0] * 10;
    b.noise[0] = a.noise[0] * 2;
    const ErrorRatio same = errorRatio(a, b, 100);
    EXPECT_NEAR(same.logRatio, std::log(0.5), 1e-6);
    EXPECT_LT(same.standardError, 1e-6);
    b.noise[0] = 100 * b.noise[1];
    EXPECT_GT(errorRatio(a, b, 100).standardError, 0.3);
}

// From 8 passes of a render what 64 tell: within 30 % of the square, 15 % of the error, since 8 passes know no better;
// the seed is fixed. One radius for all: radii by pixel, chosen in these passes, lower the noise later (docs/auto.md). Negative control: were noise not divided by passes, it would be 8 times too much.
TEST(Prediction, HoldsInARender) {
    Device device(0);
    RenderSettings settings;
    settings.photonsPerPass = 20'000;
    settings.radius = RadiusChoice::fixed;
    const Scene scene = projectScene("cornell_phong.xml", {{"resolution", "32"}});
    Renderer renderer(device, scene, settings);
    for (unsigned pass = 0; pass < 8; ++pass) renderer.renderPass(pass);
    const PilotMeasure pilot = measurePilot(renderer.develop(), false, 1);
    for (unsigned pass = 8; pass < 64; ++pass) renderer.renderPass(pass);
    const ErrorEstimate told = estimateError(renderer.develop());
    const double noise = told.total.noiseRms * told.total.noiseRms;
    EXPECT_NEAR(predictAfterPasses(pilot, 64).noise / noise, 1, 0.3);
    EXPECT_GT(predictAfterPasses(pilot, 8).noise / noise, 2);
}

// --- images as one ---

TEST(Combination, WeightsAreInverseToTheErrorAndSmallOnesAreLeftOut) {
    const auto weights = combinationWeights({{2, 1}, {1e6, 1}, {1, 1}});
    EXPECT_NEAR(weights[0], 1.0 / 3, 1e-12);
    EXPECT_EQ(weights[1], 0);
    EXPECT_NEAR(weights[2], 2.0 / 3, 1e-12);
    EXPECT_EQ(combinationWeights({{INFINITY, 1}, {INFINITY, 1}}), (std::vector<double>{0, 1}));
    // Few passes that tell of little error weigh as their time.
    EXPECT_NEAR(combinationWeights({{0.1, 1}, {1, 9}})[0], 0.1, 1e-12);
}

FilmImage syntheticImage(unsigned pixels, double mean, double deviation, std::mt19937& random) {
    FilmImage image;
    image.width = pixels;
    image.height = 1;
    image.passes = 8;
    std::normal_distribution<float> noise(static_cast<float>(mean), static_cast<float>(deviation));
    for (unsigned k = 0; k < 3 * pixels; ++k) image.radiance.push_back(noise(random));
    image.standardError.assign(3 * pixels, static_cast<float>(deviation));
    return image;
}

// Squared deviations over told variances: chi-squared of 60,000 values, 4.5 standard deviations (7e-6) either way.
// Negative control: weights that are not squared tell another variance.
TEST(Combination, ToldErrorIsTheScatter) {
    std::mt19937 random(1);
    const unsigned pixels = 20'000;
    const std::vector<FilmImage> images{syntheticImage(pixels, 5, 1, random), syntheticImage(pixels, 5, 0.5, random)};
    const std::vector<double> weights{0.2, 0.8};
    const FilmImage sum = combineImages(images, weights);
    double squares = 0;
    for (size_t k = 0; k < sum.radiance.size(); ++k)
        squares += std::pow((sum.radiance[k] - 5) / sum.standardError[k], 2);
    const double n = 3.0 * pixels, bound = 4.5 * std::sqrt(2 / n);
    EXPECT_NEAR(squares / n, 1, bound);
    const double unsquared = 0.2 * 1 + 0.8 * 0.25, right = 0.04 * 1 + 0.64 * 0.25;
    EXPECT_GT(std::abs(squares / n * right / unsquared - 1), bound);
    EXPECT_EQ(sum.passes, 16u);
}

// --- the search ---

struct Truth {
    double secondsPerPass = 0.1, noisePerPass = 1, bias = 0;
    double firstNoise = 0; // told before `honestFrom` passes, all of it even; 0: honest from the start
    unsigned honestFrom = 0;
};
using World = std::function<Truth(const RenderSettings&)>;

class FakePilot : public Pilot {
public:
    FakePilot(const Truth& truth, unsigned photons, double& clock) : truth_(truth), photons_(photons), clock_(clock) {}
    void renderPass() override {
        clock_ += truth_.secondsPerPass;
        ++passes_;
    }
    unsigned passes() const override { return passes_; }
    PilotMeasure measure() const override {
        const bool lies = passes_ < truth_.honestFrom;
        return evenPilot(passes_, lies ? truth_.firstNoise : truth_.noisePerPass, truth_.bias, truth_.secondsPerPass);
    }
    FilmImage image() const override { return {}; }
    unsigned photonsPerPass() const override { return photons_; }
    double openingSeconds() const override { return 0.05; }

private:
    Truth truth_;
    unsigned photons_, passes_ = 0;
    double& clock_;
};

struct Found {
    RenderSettings settings;
    SearchReport report;
};

Found search(const World& world, double seconds, Freedom freedom = {true, true, true, true, true},
             std::optional<double> error = std::nullopt) {
    double clock = 0;
    SearchWorld searched;
    searched.open = [&](const RenderSettings& settings) {
        clock += 0.05;
        const unsigned photons = settings.photonsPerPass > 0 ? settings.photonsPerPass : 1000;
        return std::make_unique<FakePilot>(world(settings), photons, clock);
    };
    searched.clock = [&] { return clock; };
    const Scene scene = projectScene("cornell_phong.xml");
    StopRule stop;
    stop.seconds = seconds;
    stop.relativeError = error;
    const RenderSettings start;
    auto result = Search(searched, scene, freedom, stop).run(start, searched.open(start));
    return {result.settings, result.report};
}

TEST(Search, FindsWhatIsBetterInEachCoordinate) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = (s.bdd == 1 ? 0.5 : 1) * (s.variant == Variant::alternative ? 0.6 : 1) *
                             (s.quasiSpecular == "all" ? 0.4 : 1);
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    EXPECT_EQ(found.settings.variant, Variant::alternative);
    EXPECT_EQ(found.settings.quasiSpecular, "all");
    EXPECT_THAT(found.report.line(), HasSubstr("auto: BDD 1, alternative, split all"));
}

// Negative control of the one above: the same world the other way round keeps what it started with.
TEST(Search, KeepsTheStartWhereNothingIsBetter) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        const bool isStart = s.bdd == 0 && s.variant == Variant::main && s.quasiSpecular == "auto" &&
                             s.photonsPerPass == 0 && s.radiusScale == 1;
        truth.noisePerPass = isStart ? 1 : 1.3;
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.report.chosen, 0u);
    EXPECT_GT(found.report.rows.size(), 3u);
}

TEST(Search, ChangesOnlyWhatIsOpen) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = s.bdd == 1 ? 0.1 : 1;
        return truth;
    };
    EXPECT_EQ(search(world, 200, {false, true, true, true, true}).settings.bdd, 0u);
    EXPECT_EQ(search(world, 200, {true, false, false, false, false}).settings.bdd, 1u);
    EXPECT_EQ(search(world, 200, {}).report.rows.size(), 1u);
}

TEST(Search, CostCountsAsMuchAsVariance) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = s.bdd == 1 ? 0.5 : 1;
        truth.secondsPerPass = s.bdd == 1 ? 0.3 : 0.1;
        return truth;
    };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
}

// A wide radius pays in a short render, a narrow one in a long one.
TEST(Search, BiasWeighsMoreTheLongerTheRender) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = 1 / (s.radiusScale * s.radiusScale);
        truth.bias = 0.005 * std::pow(s.radiusScale, 4);
        return truth;
    };
    const Freedom radius{false, false, false, false, true};
    EXPECT_GT(search(world, 6, radius).settings.radiusScale, 1);
    EXPECT_LT(search(world, 1e6, radius).settings.radiusScale, 1);
}

// BDD 1 hides its bright pixels for the first 6 passes. It may not win by what those passes told.
TEST(Search, IsNotTakenInByFewLuckyPasses) {
    World world = [](const RenderSettings& s) {
        Truth truth;
        if (s.bdd == 1) truth = {0.1, 20, 0, 0.2, 6};
        return truth;
    };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
    world = [](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{}; }; // control: so it would
    EXPECT_EQ(search(world, 200).settings.bdd, 1u);
}

TEST(Search, KeepsToItsShareOfTheTime) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    for (const double seconds : {2.0, 10.0, 50.0}) {
        const Found found = search(world, seconds);
        EXPECT_LE(found.report.seconds, pilotShare * seconds + 1e-9) << seconds;
    }
    const auto rows = search(world, 1.5).report.rows; // a candidate of the same kernels, once
    ASSERT_EQ(rows.size(), 2u);
    const Scene scene = projectScene("cornell_phong.xml");
    EXPECT_EQ(kernelKey(rows[1].settings, scene), kernelKey(rows[0].settings, scene));
    EXPECT_EQ(search(world, 0.9).report.rows.size(), 1u);
    EXPECT_THAT(search(world, 0.5).report.line(), HasSubstr("(1 candidate, 0 passes of others"));
}

// As where a renderer beside the best one takes more memory than the device has.
TEST(Search, LeavesOutWhatDoesNotFit) {
    const World world = [](const RenderSettings& s) {
        if (s.variant == Variant::alternative) throw InputError("too little memory");
        return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{};
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    for (const PilotRow& row : found.report.rows) EXPECT_EQ(row.settings.variant, Variant::main);
}

// A tenth less noise is not sure after four passes. In a short render no more are spent on it, in a long one (control) they are.
TEST(Search, OneDuelDoesNotTakeAllTime) {
    const World world = [](const RenderSettings& s) { return Truth{0.1, s.photonsPerPass == 0 ? 1 : 0.9}; };
    const Freedom photons{false, false, false, true, false};
    const auto mostPasses = [&](double seconds) {
        unsigned most = 0;
        for (const PilotRow& row : search(world, seconds, photons).report.rows) most = std::max(most, row.passes);
        return most;
    };
    EXPECT_EQ(mostPasses(12), 4u);
    EXPECT_GT(mostPasses(200), 4u);
}

TEST(Search, PredictsTheTimeWhereOnlyAnErrorIsAskedFor) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    const Found found = search(world, 1e6, {true, true, true, true, true}, 0.1); // 100 passes, 10 s
    EXPECT_NEAR(found.report.horizon - found.report.seconds, 10, 2);             // pilots come on top
    EXPECT_LE(found.report.seconds, pilotShare * found.report.horizon);
}

// --- the mean does not depend on the choice ---

// scenes/furnace_split.xml has radiance 2.5 everywhere, for every setting.
class CostedPilot : public RendererPilot {
public:
    CostedPilot(Device& device, const Scene& scene, const RenderSettings& settings, double& clock)
        : RendererPilot(std::make_unique<Renderer>(device, scene, settings), false), clock_(clock) {}
    void renderPass() override {
        RendererPilot::renderPass();
        clock_ += 0.1;
    }
    PilotMeasure measure() const override {
        PilotMeasure pilot = RendererPilot::measure();
        pilot.secondsPerPass = 0.1;
        return pilot;
    }
    double openingSeconds() const override { return 0; }

private:
    double& clock_;
};

double meanOf(const FilmImage& image) {
    double sum = 0;
    for (const float value : image.radiance) sum += value;
    return sum / static_cast<double>(image.radiance.size());
}

// The images that a search with this seed leaves, the chosen one last; 8 s of 0.1 s a pass.
struct Searched {
    std::vector<FilmImage> images;
    std::vector<double> seconds;
};
Searched searchedImages(Device& device, const Scene& scene, uint64_t seed) {
    double clock = 0;
    SearchWorld world;
    world.open = [&](const RenderSettings& settings) {
        return std::make_unique<CostedPilot>(device, scene, settings, clock);
    };
    world.clock = [&] { return clock; };
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    settings.seed = seed;
    StopRule stop;
    stop.seconds = 8;
    auto result = Search(world, scene, {true, true, true, false, false}, stop).run(settings, world.open(settings));
    while (clock < 4) result.best->renderPass();
    result.others.push_back(result.best->image());
    result.othersSeconds.push_back(0.1 * result.best->passes());
    return {std::move(result.others), std::move(result.othersSeconds)};
}

struct Means {
    std::vector<double> values;

    double z(double truth) const {
        double sum = 0, squares = 0;
        for (const double v : values) sum += v;
        const double n = static_cast<double>(values.size()), mean = sum / n;
        for (const double v : values) squares += (v - mean) * (v - mean);
        return (mean - truth) / std::sqrt(squares / (n * (n - 1)));
    }
};

FilmImage weightedByPixel(const std::vector<FilmImage>& images) {
    FilmImage sum = images.back();
    for (size_t k = 0; k < sum.radiance.size(); ++k) {
        double weights = 0, value = 0;
        for (const auto& image : images) {
            const double weight = 1 / (1e-12 + std::pow(image.standardError[k], 2));
            weights += weight;
            value += weight * image.radiance[k];
        }
        sum.radiance[k] = static_cast<float>(value / weights);
    }
    return sum;
}

TEST(AutoMean, IsThatOfAnyFixedChoice) {
    Device device(0);
    const Scene scene = projectScene("furnace_split.xml", {{"resolution", "12"}});
    Means combined, byPixel, darker;
    size_t added = 0;
    for (uint64_t seed = 1; seed <= 48; ++seed) {
        const auto [images, seconds] = searchedImages(device, scene, seed);
        added += images.size() - 1;
        combined.values.push_back(meanOf(combineImages(images, weightsByError(images, seconds))));
        byPixel.values.push_back(meanOf(weightedByPixel(images)));
        double dark = INFINITY;
        for (const auto& image : images) dark = std::min(dark, meanOf(image));
        darker.values.push_back(dark);
    }
    EXPECT_GT(added, 48u) << "nothing was added that could change the mean";
    EXPECT_LT(std::abs(combined.z(2.5)), 4);
    // Negative controls: weights by the pixel's own variance, or keeping the darkest image, are seen.
    EXPECT_LT(byPixel.z(2.5), -4);
    EXPECT_LT(darker.z(2.5), -4);
}

} // namespace
} // namespace quasilux
