// Rough dielectrics as lobes: their formula in double, reciprocity between the two sides, samples against the density
// over the whole sphere, energy of both parts, flux against radiance, and the limit of a smooth surface. False-alarm
// rate of the program 1e-4 (support/chi_squared.h).
#include "bsdf/lobe_list.h"
#include "support/float_rounding.h"
#include "support/rough_interface.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr int radiance = 0, flux = 1; // TRANSPORT_*
constexpr size_t sampleCount = 100000;
constexpr double cosines[] = {0.95, 0.5, 0.1};

// Chi-squared, and the mean weight of each of two parts.
int statisticalTests() { return static_cast<int>(3 * roughInterfaces().size() * std::size(cosines)); }

template <typename Check>
void forAllInterfaces(Check check) {
    for (const LobeCase& c : roughInterfaces())
        for (double cosine : cosines) {
            SCOPED_TRACE(c.name + ", wo.z = " + std::to_string(cosine));
            check(c.lobe, outgoing(cosine));
        }
}

std::vector<dvec3> directionsOver(const shared::Lobe& lobe, dvec3 wo) {
    std::vector<dvec3> wi;
    for (const InterfacePoint& p : interfaceQuadrature(lobe, wo, 1))
        if (std::abs(p.wi.z) > 1e-3) wi.push_back(roundToFloat(p.wi));
    return wi;
}

TEST(RoughDielectric, agreesWithItsFormulaOnBothSides) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        const auto wi = directionsOver(lobe, wo);
        ASSERT_GT(wi.size(), 50u);
        const auto values = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
        for (size_t i = 0; i < wi.size(); ++i) {
            const double exact = interfaceFormula(lobe, wo, wi[i]);
            ASSERT_NEAR(values[i].f.y, exact, 5e-5 * exact + 1e-12) << wi[i].x << " " << wi[i].y << " " << wi[i].z;
        }
    });
}

TEST(RoughDielectric, isReciprocalWithTheSquareOfEtaBetweenItsSides) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        shared::Lobe behind = lobe;
        behind.eta.r = 1 / lobe.eta.r;
        const auto turned = [](dvec3 v) { return dvec3(v.x, -v.y, -v.z); }; // the frame of the other side
        for (const dvec3& wi : directionsOver(lobe, wo)) {
            const double forth = evaluateLobe(lobe, {wo}, {wi})[0].f.y;
            const double eta2 = double(lobe.eta.r) * lobe.eta.r;
            const double back = wi.z > 0 ? evaluateLobe(lobe, {wi}, {wo})[0].f.y
                                         : evaluateLobe(behind, {turned(wi)}, {turned(wo)})[0].f.y / eta2;
            ASSERT_NEAR(forth, back, 1e-4 * forth + 1e-12);
        }
    });
}

std::vector<uint64_t> countCells(const shared::Lobe& lobe, dvec3 wo, const std::vector<SampledDirection>& samples) {
    std::vector<uint64_t> counts(2 * interfaceGrid.cells() + 1);
    for (const SampledDirection& s : samples)
        ++counts[s.valid ? interfaceCell(lobe, wo, s.wi) : 2 * interfaceGrid.cells()];
    return counts;
}

std::vector<double> cellProbabilities(const shared::Lobe& lobe, dvec3 wo) {
    // The horizon cuts through cells, where the density of Beckmann samples does not vanish.
    const bool cut = lobe.type == LOBE_BECKMANNDIELECTRIC && wo.z < 0.2;
    const auto points = interfaceQuadrature(lobe, wo, cut ? 72 : 16);
    std::vector<dvec3> wi;
    for (const InterfacePoint& p : points) wi.push_back(p.wi);
    const auto values = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
    std::vector<double> probabilities(2 * interfaceGrid.cells());
    for (size_t i = 0; i < points.size(); ++i) probabilities[points[i].cell] += values[i].pdf * points[i].solidAngle;
    return probabilities;
}

double fit(const shared::Lobe& lobe, const shared::Lobe& tested, dvec3 wo) {
    const auto samples = sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 31));
    return chiSquaredPValue(countCells(tested, wo, samples), cellProbabilities(tested, wo));
}

TEST(RoughDielectric, samplesFollowTheirDensityOverTheSphere) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        EXPECT_GT(fit(lobe, lobe, wo), significanceLevel(statisticalTests()));
    });
}

TEST(RoughDielectric, negativeControlWrongDensityFails) {
    for (unsigned type : {LOBE_GGXDIELECTRIC, LOBE_BECKMANNDIELECTRIC}) {
        const shared::Lobe right = makeInterface(type, 1.5f, 0.3f, 0.3f);
        shared::Lobe rougher = right, denser = right;
        rougher.alphaV *= 1.05f;
        denser.eta = {1.55f, 1.55f, 1.55f};
        EXPECT_LT(fit(right, rougher, outgoing(0.5)), significanceLevel(statisticalTests()));
        EXPECT_LT(fit(right, denser, outgoing(0.5)), significanceLevel(statisticalTests()));
    }
}

TEST(RoughDielectric, weightIsFCosineOverPdfAndTheSquareOfEtaIsOfRadianceOnly) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        const auto numbers = uniformNumbers(3 * 2000, 32);
        const auto samples = sampleLobe(lobe, wo, numbers, radiance), ofFlux = sampleLobe(lobe, wo, numbers, flux);
        std::vector<dvec3> wi;
        for (const SampledDirection& s : samples) wi.push_back(s.wi);
        const auto values = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
        const double eta2 = double(lobe.eta.r) * lobe.eta.r;
        for (size_t i = 0; i < samples.size(); ++i) {
            const SampledDirection& s = samples[i];
            // Grazing or at the critical angle a float direction does not fix the facet any more.
            if (!s.valid || std::abs(s.wi.z) < 0.02) continue;
            const double tolerance = 1e-4 + 4e-6 / (std::min(lobe.alphaU, lobe.alphaV) * wo.z);
            ASSERT_NEAR(glm::length(s.wi), 1, 1e-6);
            ASSERT_NEAR(s.pdf / values[i].pdf, 1, tolerance) << s.wi.z;
            ASSERT_NEAR(s.weight.y * s.pdf / (values[i].f.y * std::abs(s.wi.z)), 1, tolerance) << s.wi.z;
            ASSERT_EQ(ofFlux[i].wi, s.wi);
            ASSERT_NEAR(ofFlux[i].weight.y, s.weight.y * (s.wi.z < 0 ? eta2 : 1), 1e-6 * ofFlux[i].weight.y);
        }
    });
}

struct MeanWeight {
    double mean = 0, deviation = 0;
};
MeanWeight meanWeight(const std::vector<SampledDirection>& samples, bool transmitted) {
    double sum = 0, squares = 0;
    for (const SampledDirection& s : samples) {
        const double weight = s.valid && (s.wi.z < 0) == transmitted ? s.weight.y : 0;
        sum += weight;
        squares += weight * weight;
    }
    const auto n = static_cast<double>(samples.size());
    return {sum / n, std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0) / n)};
}

TEST(RoughDielectric, meanWeightsAreTheSharesAndNoEnergyIsMade) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        const InterfaceShares shares = interfaceShares(lobe, wo);
        const auto samples = sampleLobe(lobe, wo, uniformNumbers(3 * sampleCount, 33), radiance);
        const auto expectShare = [&](bool transmitted, double share) {
            const MeanWeight weight = meanWeight(samples, transmitted);
            const double z =
                std::max(std::abs(weight.mean - share) - 1e-3 * share - 1e-6, 0.0) / std::max(weight.deviation, 1e-12);
            EXPECT_GT(normalPValue(z), significanceLevel(statisticalTests())) << weight.mean << " not " << share;
        };
        expectShare(false, shares.reflected);
        expectShare(true, shares.transmitted);
        const double scattered = shares.reflected + double(lobe.eta.r) * lobe.eta.r * shares.transmitted;
        EXPECT_LT(scattered, 1.001);
        const double estimate = lobeAlbedos(lobe, {wo})[0].y;
        EXPECT_GT(estimate / scattered, 0.85) << "the estimate to choose lobes by";
        EXPECT_LT(estimate / scattered, 3.5);
    });
}

TEST(RoughDielectric, isTheSmoothOneInTheLimit) {
    for (unsigned type : {LOBE_GGXDIELECTRIC, LOBE_BECKMANNDIELECTRIC})
        for (float eta : {1.5f, 1 / 1.5f})
            for (double cosine : {1.0, 0.9, 0.5}) {
                shared::Lobe smooth = makeInterface(LOBE_DIELECTRIC, eta, 0, 0);
                const shared::Lobe rough = makeInterface(type, eta, 2e-3f, 2e-3f);
                const dvec3 wo = outgoing(cosine);
                const auto numbers = uniformNumbers(3 * 20000, 34);
                const auto expected = sampleLobe(smooth, wo, numbers, flux),
                           found = sampleLobe(rough, wo, numbers, flux);
                // Binomial spread is shared, since both choose by the same numbers.
                for (bool transmitted : {false, true})
                    EXPECT_NEAR(meanWeight(found, transmitted).mean, meanWeight(expected, transmitted).mean, 2e-3);
                size_t far = 0;
                for (size_t i = 0; i < found.size(); ++i)
                    far += found[i].wi.z * expected[i].wi.z > 0 && glm::length(found[i].wi - expected[i].wi) > 0.05;
                EXPECT_LT(far, found.size() / 100) << "the tail of GGX: half width 0.004";
            }
}

TEST(RoughDielectric, reflectsTotallyWhereNoFacetTransmitsButRoughFacetsDo) {
    const dvec3 wo = outgoing(0.5); // the critical angle's cosine is 0.745
    const auto share = [&](float alpha) {
        const auto lobe = makeInterface(LOBE_BECKMANNDIELECTRIC, 1 / 1.5f, alpha, alpha);
        return meanWeight(sampleLobe(lobe, wo, uniformNumbers(3 * 20000, 35), flux), true).mean;
    };
    EXPECT_EQ(share(0.02f), 0);
    EXPECT_GT(share(0.5f), 0.05);
    shared::Lobe onlyTransmits = makeInterface(LOBE_GGXDIELECTRIC, 1 / 1.5f, 0.5f, 0.5f);
    onlyTransmits.reflectance = {0, 0, 0};
    EXPECT_GT(lobeAlbedos(onlyTransmits, {wo})[0].y, 0) << "or it would never be chosen";
}

TEST(RoughDielectric, partsScaleApart) {
    const dvec3 wo = outgoing(0.7), up = dvec3(-wo.x, -wo.y, wo.z), down = dvec3(-wo.x / 1.5, -wo.y / 1.5, -0.88);
    for (unsigned type : {LOBE_GGXDIELECTRIC, LOBE_BECKMANNDIELECTRIC}) {
        shared::Lobe lobe = makeInterface(type, 1.5f, 0.3f, 0.3f);
        lobe.reflectance = {0, 0, 0};
        lobe.transmittance = {1, 0.5f, 0};
        EXPECT_EQ(evaluateLobe(lobe, {wo}, {up})[0].f, dvec3(0));
        const dvec3 f = evaluateLobe(lobe, {wo}, {down})[0].f;
        EXPECT_GT(f.x, 0);
        EXPECT_NEAR(f.y, 0.5 * f.x, 1e-6 * f.x);
        EXPECT_EQ(f.z, 0);
        for (const SampledDirection& s : sampleLobe(lobe, wo, uniformNumbers(3 * 1000, 36)))
            EXPECT_TRUE(!s.valid || s.wi.z < 0) << "a black part must not be sampled";
        lobe.transmittance = {0, 0, 0};
        for (const SampledDirection& s : sampleLobe(lobe, wo, extremeNumbers(3)))
            EXPECT_EQ(s.valid ? s.weight : dvec3(0), dvec3(0));
    }
}

TEST(RoughDielectric, isTheSameWhereItIsTheOnlyLobeCompiled) {
    forAllInterfaces([](const shared::Lobe& lobe, dvec3 wo) {
        const auto wi = directionsOver(lobe, wo);
        const std::string id = lobe.type == LOBE_GGXDIELECTRIC ? "GGXDIELECTRIC" : "BECKMANNDIELECTRIC";
        const auto all = evaluateLobe(lobe, std::vector(wi.size(), wo), wi);
        const auto alone = evaluateLobe(lobe, std::vector(wi.size(), wo), wi, "-DHAS_LOBE_" + id + " -DONE_LOBE_TYPE");
        for (size_t i = 0; i < wi.size(); ++i) ASSERT_NEAR(alone[i].f.y, all[i].f.y, 1e-5 * all[i].f.y);
    });
}

TEST(RoughDielectric, endsOfTheUnitIntervalGiveFiniteSamples) {
    for (const LobeCase& c : roughInterfaces())
        for (double cosine : outgoingCosines())
            for (const SampledDirection& s : sampleLobe(c.lobe, outgoing(cosine), extremeNumbers(3))) {
                if (!s.valid) continue;
                ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf > 0) << c.name << " " << s.pdf;
                ASSERT_TRUE(std::isfinite(s.weight.y) && s.weight.y >= 0) << c.name;
                ASSERT_NEAR(glm::length(s.wi), 1, 1e-6) << c.name;
            }
}

} // namespace
} // namespace quasilux
