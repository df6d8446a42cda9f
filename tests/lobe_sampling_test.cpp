// Do lobe samples follow their density and carry the right energy? Chi-squared tests of every finite lobe against its
// pdf, and z tests of the mean weight against the albedo by quadrature. False-alarm rate of the program 1e-4
// (support/chi_squared.h).
#include "bsdf/lobe_list.h"
#include "support/chi_squared.h"
#include "support/lobe_cases.h"
#include "support/lobe_coordinates.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr double twoPi = 2 * std::numbers::pi;
constexpr SampleGrid grid{0, 1, 0, twoPi, 10, 16};
constexpr int pointsPerSide = 24;
constexpr size_t sampleCount = 100000;

int statisticalTests() { return static_cast<int>(2 * finiteLobes().size() * outgoingCosines().size()); }

/// Where the grid's quadrature points are, and what the kernel says of them.
struct Quadrature {
    std::vector<QuadraturePoint> points;
    std::vector<LobeDirection> directions;
    std::vector<EvaluatedDirection> values;
};

/// The horizon cuts through cells; the density of samples by D cos does not vanish there, which takes a finer rule.
int quadratureFineness(const shared::Lobe& lobe, glm::dvec3 wo) {
    return (lobe.type == LOBE_BECKMANN || lobe.type == LOBE_CLEARCOAT) && wo.z < 0.2 ? 3 * pointsPerSide
                                                                                     : pointsPerSide;
}

Quadrature evaluateOnGrid(const shared::Lobe& lobe, glm::dvec3 wo) {
    Quadrature q{gridQuadrature(grid, quadratureFineness(lobe, wo)), {}, {}};
    std::vector<glm::dvec3> wi;
    for (const QuadraturePoint& p : q.points) {
        q.directions.push_back(lobeDirection(lobe, wo, p.u, p.v));
        wi.push_back(q.directions.back().wi);
    }
    q.values = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
    return q;
}

/// Probability of a valid sample in each cell.
std::vector<double> cellProbabilities(const Quadrature& q) {
    std::vector<double> probabilities(grid.cells());
    for (size_t i = 0; i < q.points.size(); ++i)
        if (q.directions[i].wi.z > 0)
            probabilities[q.points[i].cell] += q.values[i].pdf * q.directions[i].solidAngle * q.points[i].weight;
    return probabilities;
}

std::vector<uint64_t> countSamples(const shared::Lobe& lobe, glm::dvec3 wo,
                                   const std::vector<SampledDirection>& samples) {
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const SampledDirection& s : samples) {
        const LobeCoordinates c = lobeCoordinates(lobe, wo, s.wi);
        ++counts[s.valid ? grid.cell(c.s, c.phi) : grid.cells()];
    }
    return counts;
}

template <typename Check>
void forAllLobes(Check check) {
    for (const LobeCase& c : finiteLobes())
        for (double cosine : outgoingCosines()) {
            SCOPED_TRACE(c.name + ", wo.z = " + std::to_string(cosine));
            check(c.lobe, outgoing(cosine));
        }
}

TEST(LobeSampling, followsItsDensity) {
    forAllLobes([](const shared::Lobe& lobe, glm::dvec3 wo) {
        const auto samples = sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 17));
        EXPECT_GT(chiSquaredPValue(countSamples(lobe, wo, samples), cellProbabilities(evaluateOnGrid(lobe, wo))),
                  significanceLevel(statisticalTests()));
    });
}

TEST(LobeSampling, negativeControlWrongDensityFails) {
    const auto wrongFit = [](shared::Lobe lobe, shared::Lobe wrong, double cosine) {
        const glm::dvec3 wo = outgoing(cosine);
        const auto samples = sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 17));
        return chiSquaredPValue(countSamples(wrong, wo, samples), cellProbabilities(evaluateOnGrid(wrong, wo)));
    };
    shared::Lobe phong = makeLobe(LOBE_PHONG), wrongPhong = phong;
    phong.exponent = 1000;
    wrongPhong.exponent = 1050;
    EXPECT_LT(wrongFit(phong, wrongPhong, 0.9), significanceLevel(statisticalTests()));
    for (unsigned type : {LOBE_GGX, LOBE_BECKMANN}) {
        shared::Lobe right = makeLobe(type), wrong = right;
        wrong.alphaV *= 1.05f;
        EXPECT_LT(wrongFit(right, wrong, 0.5), significanceLevel(statisticalTests()));
    }
}

TEST(LobeSampling, densityIntegratesToTheValidShare) {
    forAllLobes([](const shared::Lobe& lobe, glm::dvec3 wo) {
        const Quadrature q = evaluateOnGrid(lobe, wo);
        double all = 0, aboveHorizon = 0;
        for (size_t i = 0; i < q.points.size(); ++i) {
            const double share = q.values[i].pdf * q.directions[i].solidAngle * q.points[i].weight;
            all += share;
            if (q.directions[i].wi.z > 0) aboveHorizon += share;
        }
        EXPECT_LT(all, 1 + 2e-3);
        const bool losesNothing =
            LOBE_IS_BROAD(lobe.type) || lobe.type == LOBE_PHONG; // Phong's pdf goes on below the horizon
        if (losesNothing) {
            EXPECT_NEAR(all, 1, 2e-3);
        }
        const bool wholeLobeAbove = lobe.type == LOBE_GGX && lobe.alphaU < 0.05f && wo.z > 0.4;
        if (wholeLobeAbove) {
            EXPECT_NEAR(aboveHorizon, 1, 2e-3);
        }
    });
}

TEST(LobeSampling, meanWeightIsTheAlbedo) {
    forAllLobes([](const shared::Lobe& lobe, glm::dvec3 wo) {
        double albedo = 0;
        for (const QuadraturePoint& p : gridQuadrature(grid, 2 * pointsPerSide)) {
            const LobeDirection d = lobeDirection(lobe, wo, p.u, p.v);
            albedo += lobeFormula(lobe, wo, d.wi) * d.wi.z * d.solidAngle * p.weight;
        }
        double sum = 0, sumOfSquares = 0;
        for (const SampledDirection& s : sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 18))) {
            const double weight = s.valid ? s.weight.y : 0;
            sum += weight;
            sumOfSquares += weight * weight;
        }
        const double mean = sum / sampleCount;
        const double deviation = std::sqrt(std::max(sumOfSquares / sampleCount - mean * mean, 0.0) / sampleCount);
        // 3e-4 for the quadrature's and the floats' own error, where the weight hardly varies.
        const double z = std::max(std::abs(mean - albedo) - 3e-4 * albedo, 0.0) / std::max(deviation, 1e-12);
        EXPECT_GT(normalPValue(z), significanceLevel(statisticalTests())) << mean << " instead of " << albedo;
        const bool amplifies = lobe.type == LOBE_PRINCIPLEDDIFFUSE; // its model does, at grazing incidence
        EXPECT_LE(albedo, amplifies ? 1.25 : 1 + 1e-3) << "a white surface must not amplify";
    });
}

TEST(LobeSampling, weightIsFCosineOverPdf) {
    forAllLobes([](const shared::Lobe& lobe, glm::dvec3 wo) {
        const auto samples = sampleLobe(lobe, wo, uniformNumbers(3 * 2000, 19));
        std::vector<glm::dvec3> wi;
        for (const SampledDirection& s : samples) wi.push_back(s.wi);
        const auto values = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
        // A float direction fixes a narrow lobe's value only so far: rounding over the lobe's width, and over the
        // grazing cosine.
        const double width = lobe.type == LOBE_PHONG    ? 1 / std::sqrt(lobe.exponent + 1.0)
                             : LOBE_IS_BROAD(lobe.type) ? 1.0
                                                        : std::min(lobe.alphaU, lobe.alphaV) * wo.z;
        const double tolerance = 2e-5 + 4e-6 / width;
        for (size_t i = 0; i < samples.size(); ++i) {
            const SampledDirection& s = samples[i];
            if (!s.valid) continue;
            ASSERT_GT(s.pdf, 0);
            ASSERT_NEAR(s.pdf / values[i].pdf, 1, tolerance);
            ASSERT_NEAR(s.weight.y * s.pdf / (values[i].f.y * s.wi.z), 1, tolerance);
            ASSERT_NEAR(glm::length(s.wi), 1, 1e-6);
        }
    });
}

TEST(LobeSampling, endsOfTheUnitIntervalGiveFiniteSamples) {
    forAllLobes([](const shared::Lobe& lobe, glm::dvec3 wo) {
        for (const SampledDirection& s : sampleLobe(lobe, wo, extremeNumbers(3))) {
            if (!s.valid) continue;
            ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf > 0);
            ASSERT_TRUE(std::isfinite(s.weight.y) && s.weight.y >= 0);
            ASSERT_NEAR(glm::length(s.wi), 1, 1e-6);
            ASSERT_GT(s.wi.z, 0);
        }
    });
}

} // namespace
} // namespace quasilux
