// Warps of kernels/sampling.clh: coverage against their densities, moments, and the ends of the unit interval.
// 8 chi-squared tests; false-alarm rate of the program 1e-4 (support/chi_squared.h).
#include "support/chi_squared.h"
#include "support/float_rounding.h"
#include "support/test_kernels.h"

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int statisticalTests = 8;
constexpr size_t sampleCount = 200000;

enum Warp : cl_uint { Disc, CosineHemisphere, UniformSphere, UniformCone, Triangle };

struct Warped {
    dvec3 point;
    double pdf;
};

std::vector<Warped> warp(Warp kind, const std::vector<float>& u, double parameter = 0) {
    static Program program = testProgram("sampling.cl");
    const size_t count = u.size() / 2;
    Buffer<float> in(testDevice(), u, "numbers"), out(testDevice(), 4 * count, "warped");
    program.kernel("warpNumbers").launch(count, cl_uint(kind), float(parameter), in, out, cl_uint(count));
    const auto values = out.read();
    std::vector<Warped> result(count);
    for (size_t i = 0; i < count; ++i)
        result[i] = {{values[4 * i], values[4 * i + 1], values[4 * i + 2]}, values[4 * i + 3]};
    return result;
}

/// p-value of the samples, by a map to (a,b) in the unit square under which they must be uniform.
double uniformFit(const std::vector<Warped>& samples, const std::function<std::pair<double, double>(dvec3)>& map) {
    const SampleGrid grid{0, 1, 0, 1, 20, 20};
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const Warped& s : samples) {
        const auto [a, b] = map(s.point);
        ++counts[grid.cell(a, b)];
    }
    return chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells()));
}

double azimuth(dvec3 p) { return std::atan2(p.y, p.x) / (2 * pi) + 0.5; }

/// 1 - cos of the angle to +z from the sine, for directions near it.
double oneMinusCos(dvec3 p) {
    const double sin2 = p.x * p.x + p.y * p.y;
    return p.z > 0 ? sin2 / (1 + std::sqrt(std::max(1 - sin2, 0.0))) : 1 - p.z;
}

double clampToOne(double x) { return x < 1 + 1e-5 ? std::min(x, 1.0) : x; }

TEST(Warps, coverTheirDomainUniformly) {
    const auto u = uniformNumbers(2 * sampleCount, 21);
    const double level = significanceLevel(statisticalTests);
    EXPECT_GT(
        uniformFit(warp(Disc, u), [](dvec3 p) { return std::pair(clampToOne(p.x * p.x + p.y * p.y), azimuth(p)); }),
        level);
    EXPECT_GT(uniformFit(warp(CosineHemisphere, u), [](dvec3 p) { return std::pair(p.z * p.z, azimuth(p)); }), level);
    EXPECT_GT(uniformFit(warp(UniformSphere, u), [](dvec3 p) { return std::pair(0.5 + 0.5 * p.z, azimuth(p)); }),
              level);
    EXPECT_GT(uniformFit(warp(Triangle, u),
                         [](dvec3 p) { return std::pair(std::pow(p.x + p.y, 2), p.y / std::max(p.x + p.y, 1e-30)); }),
              level);
    for (double width : {1e-12, 1e-4, 1., 1.5})
        EXPECT_GT(uniformFit(
                      warp(UniformCone, u, width),
                      [=](dvec3 p) { return std::pair(clampToOne(oneMinusCos(p) / roundToFloat(width)), azimuth(p)); }),
                  level)
            << width;
}

TEST(Warps, negativeControlABentHemisphereIsFound) {
    // Uniform samples bent towards the pole by 5 %, as a wrong power of u would give.
    auto samples = warp(UniformCone, uniformNumbers(2 * sampleCount, 21), 1);
    EXPECT_LT(uniformFit(samples, [](dvec3 p) { return std::pair(std::pow(p.z, 1.05), azimuth(p)); }),
              significanceLevel(statisticalTests));
}

TEST(Warps, densitiesAreOneOverTheMeasureOfTheDomain) {
    const std::vector<float> u{0.3f, 0.6f};
    EXPECT_NEAR(warp(Disc, u)[0].pdf, 1 / pi, 1e-7);
    EXPECT_NEAR(warp(UniformSphere, u)[0].pdf, 1 / (4 * pi), 1e-7);
    EXPECT_NEAR(warp(UniformCone, u, 1e-12)[0].pdf * 2 * pi * 1e-12, 1, 1e-6);
    EXPECT_NEAR(warp(Triangle, u)[0].pdf, 2, 1e-7);
    const Warped cosine = warp(CosineHemisphere, u)[0];
    EXPECT_NEAR(cosine.pdf, cosine.point.z / pi, 1e-7);
}

TEST(Warps, endsOfTheUnitIntervalStayInsideWithPositiveDensity) {
    const auto u = extremeNumbers(2);
    for (Warp kind : {CosineHemisphere, UniformSphere, UniformCone})
        for (const Warped& s : warp(kind, u, 0.5)) {
            ASSERT_NEAR(glm::length(s.point), 1, 3e-7) << kind;
            ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf > 0) << kind;
            if (kind != UniformSphere) {
                ASSERT_GT(s.point.z, 0) << kind;
            }
        }
    for (const Warped& s : warp(Disc, u)) ASSERT_LE(glm::length(s.point), 1);
    for (const Warped& s : warp(Triangle, u)) {
        ASSERT_GE(std::min(s.point.x, s.point.y), 0);
        ASSERT_LE(s.point.x + s.point.y, 1);
    }
}

TEST(ChiSquared, gammaFunctionMatchesClosedForms) {
    for (double x : {0.01, 0.5, 1.0, 3.0, 20.0, 200.0}) {
        EXPECT_NEAR(regularisedGammaQ(1, x) / std::exp(-x), 1, 1e-12);
        EXPECT_NEAR(regularisedGammaQ(0.5, x) / std::erfc(std::sqrt(x)), 1, 1e-9);
        EXPECT_NEAR(regularisedGammaQ(2, x) / ((1 + x) * std::exp(-x)), 1, 1e-9);
    }
    EXPECT_NEAR(regularisedGammaQ(500, 500), 0.494053, 1e-5);
}

TEST(ChiSquared, pValuesOfTrueHypothesesAreUniform) {
    // 2000 histograms that follow their probabilities, some cells so rare that they must be pooled.
    const std::vector<double> probabilities{0.3, 0.2, 0.2, 0.1, 0.1, 0.05, 0.03, 0.015, 0.004, 0.0005, 0.0005};
    std::vector<uint64_t> deciles(10);
    const auto u = uniformNumbers(2000 * 1000, 22);
    for (size_t trial = 0; trial < 2000; ++trial) {
        std::vector<uint64_t> counts(probabilities.size());
        for (size_t i = 0; i < 1000; ++i) {
            double rest = u[trial * 1000 + i];
            size_t cell = 0;
            while (cell + 1 < counts.size() && rest >= probabilities[cell]) rest -= probabilities[cell++];
            ++counts[cell];
        }
        ++deciles[std::min<size_t>(9, static_cast<size_t>(10 * chiSquaredPValue(counts, probabilities)))];
    }
    EXPECT_GT(chiSquaredPValue(deciles, std::vector<double>(10, 0.1)), 1e-4);
}

} // namespace
} // namespace quasilux
