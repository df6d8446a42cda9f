// The standard error of the bias where its noise grows from pass to pass, as it does while discs shrink.
//
// False alarms: the mean of 12288 independent estimates of a variance scatters by 0.5 % (each from as few as 20
// batches), so bounds of 2 % raise one in 15,000 runs.
#include "render/film.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

struct Float4 {
    float x, y, z, w;
};

constexpr unsigned side = 64, pixels = side * side;
constexpr float meanBias = 0.3f;

/// Bias of a pass, of variance 1 + pass, times its weight.
std::vector<Float4> biasOfPass(unsigned pass, float weight, std::mt19937& random) {
    std::normal_distribution<float> value(meanBias, std::sqrt(1.f + float(pass)));
    std::vector<Float4> bias(pixels);
    for (Float4& b : bias) b = {weight * value(random), weight * value(random), weight * value(random), 0};
    return bias;
}

/// Variance of the mean of all channels, as the film estimates it after some passes.
struct Estimated {
    double byFilm = 0, truth = 0;
    double byMeanSquares = 0; ///< as if noise were the same in all passes: squares of batches divided by their passes
};

Estimated estimatedAfter(unsigned passes) {
    Program program = testProgram("film.cl", "-DBVH_STACK_SIZE=32 -DPHOTON_CLASSES=8u -DESTIMATE_BIAS=1");
    Kernel add = program.kernel("addBiasOfPass");
    Film film(testDevice(), side, side, FilmLayout{});
    std::mt19937 random(7);
    Estimated estimated;
    std::vector<double> sum(3 * pixels), open(3 * pixels), squares(3 * pixels);
    double weights = 0, inBatch = 0, batches = 0;
    for (unsigned pass = 0; pass < passes; ++pass) {
        const Film::Pass now = film.beginPass(pass);
        const auto bias = biasOfPass(pass, now.biasWeight, random);
        Buffer<Float4> input(testDevice(), bias, "bias");
        add.launch(pixels, input, film.sums(), pixels, now.batchWeight, film.layout().bits());
        weights += now.biasWeight;
        inBatch += now.biasWeight;
        estimated.truth += now.biasWeight * now.biasWeight * (1 + pass);
        const bool ends = now.batchWeight > 0 || (pass + 1 == passes && inBatch > 0);
        for (size_t k = 0; k < sum.size(); ++k) {
            sum[k] += (&bias[k / 3].x)[k % 3];
            open[k] += (&bias[k / 3].x)[k % 3];
        }
        if (!ends) continue;
        for (size_t k = 0; k < open.size(); ++k) squares[k] += open[k] * open[k] / inBatch;
        std::fill(open.begin(), open.end(), 0);
        batches += 1;
        inBatch = 0;
    }
    estimated.truth /= weights * weights;
    const FilmImage image = film.develop(passes);
    for (size_t k = 0; k < sum.size(); ++k) {
        const double error = image.biasError[k], values = double(sum.size());
        EXPECT_NEAR(image.bias[k], sum[k] / weights, 1e-4);
        estimated.byFilm += error * error / values;
        estimated.byMeanSquares += (squares[k] - sum[k] * sum[k] / weights) / (weights * (batches - 1)) / values;
    }
    return estimated;
}

TEST(FilmBias, StandardErrorHoldsWhileNoiseGrows) {
    for (const unsigned passes : {10u, 30u, 64u, 256u}) { // 30: amid a batch
        const Estimated estimated = estimatedAfter(passes);
        EXPECT_NEAR(estimated.byFilm / estimated.truth, 1, 0.02) << passes;
        if (passes <= 16) continue; // all batches are single passes
        EXPECT_LT(estimated.byMeanSquares / estimated.truth, 0.95) << passes << ", control";
    }
}

} // namespace
} // namespace quasilux
