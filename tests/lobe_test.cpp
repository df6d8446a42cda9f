// Values of the lobes: their formulas in double, reciprocity, the horizon, albedo estimates, and delta lobes with
// Fresnel.
#include "bsdf/lobe_list.h"
#include "support/chi_squared.h"
#include "support/float_rounding.h"
#include "support/lobe_cases.h"
#include "support/lobe_coordinates.h"
#include "support/test_kernels.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int radiance = 0, flux = 1; // TRANSPORT_*

/// Directions all over the lobe, above the horizon.
std::vector<dvec3> directionsOver(const shared::Lobe& lobe, dvec3 wo) {
    std::vector<dvec3> wi;
    for (const QuadraturePoint& p : gridQuadrature({0, 1, 0, 2 * pi, 16, 16}, 1)) {
        const dvec3 d = glm::normalize(lobeDirection(lobe, wo, p.u, p.v).wi);
        if (d.z > 1e-3) wi.push_back(roundToFloat(d));
    }
    return wi;
}

/// Relative error of f for directions that are exact in float, whatever the lobe's width.
constexpr double tolerance = 2e-5;

TEST(Lobes, agreeWithTheirFormulas) {
    for (const LobeCase& c : finiteLobes())
        for (double cosine : outgoingCosines()) {
            const dvec3 wo = outgoing(cosine);
            const auto wi = directionsOver(c.lobe, wo);
            const auto values = evaluateLobe(c.lobe, std::vector(wi.size(), wo), wi);
            for (size_t i = 0; i < wi.size(); ++i) {
                const double exact = lobeFormula(c.lobe, wo, wi[i]);
                ASSERT_NEAR(values[i].f.y, exact, tolerance * exact + 1e-12) << c.name << ", wo.z = " << cosine;
            }
        }
}

TEST(Lobes, areReciprocal) {
    for (const LobeCase& c : finiteLobes())
        for (double cosine : outgoingCosines()) {
            const dvec3 wo = outgoing(cosine);
            const auto wi = directionsOver(c.lobe, wo);
            const auto forth = evaluateLobe(c.lobe, std::vector(wi.size(), wo), wi);
            const auto back = evaluateLobe(c.lobe, wi, std::vector(wi.size(), wo));
            for (size_t i = 0; i < wi.size(); ++i)
                ASSERT_NEAR(forth[i].f.y, back[i].f.y, tolerance * forth[i].f.y + 1e-12) << c.name;
        }
}

TEST(Lobes, areTheSameWhereTheyAreTheOnlyOneCompiled) {
    const std::map<unsigned, const char*> options = {
        {LOBE_LAMBERT, "-DHAS_LOBE_LAMBERT"},
        {LOBE_PHONG, "-DHAS_LOBE_PHONG"},
        {LOBE_GGX, "-DHAS_LOBE_GGX"},
        {LOBE_BECKMANN, "-DHAS_LOBE_BECKMANN"},
        {LOBE_COATEDLAMBERT, "-DHAS_LOBE_COATEDLAMBERT"},
        {LOBE_ROUGHCOATEDLAMBERT, "-DHAS_LOBE_ROUGHCOATEDLAMBERT -DHAS_LOW_COATS"},
        {LOBE_PRINCIPLEDDIFFUSE, "-DHAS_LOBE_PRINCIPLEDDIFFUSE"},
        {LOBE_SHEEN, "-DHAS_LOBE_SHEEN"},
        {LOBE_GGXSCHLICK, "-DHAS_LOBE_GGXSCHLICK"},
        {LOBE_CLEARCOAT, "-DHAS_LOBE_CLEARCOAT"}};
    const dvec3 wo = outgoing(0.5);
    for (const LobeCase& c : finiteLobes()) {
        const auto wi = directionsOver(c.lobe, wo);
        const auto together = evaluateLobe(c.lobe, std::vector(wi.size(), wo), wi);
        const auto alone = evaluateLobe(c.lobe, std::vector(wi.size(), wo), wi, options.at(c.lobe.type));
        for (size_t i = 0; i < wi.size(); ++i) {
            ASSERT_NEAR(alone[i].f.y, together[i].f.y, 1e-5 * together[i].f.y) << c.name;
            ASSERT_NEAR(alone[i].pdf, together[i].pdf, 1e-5 * together[i].pdf) << c.name;
        }
    }
    EXPECT_EQ(evaluateLobe(makeLobe(LOBE_LAMBERT), {wo}, {wo}, "-DHAS_LOBE_PHONG -DHAS_LOBE_GGX")[0].f, dvec3(0))
        << "a lobe that is not compiled scatters nothing";
}

TEST(Lobes, areBlackBelowTheHorizon) {
    const dvec3 wo = outgoing(0.5);
    for (const LobeCase& c : finiteLobes())
        for (const dvec3 wi : {dvec3(0.6, 0, -0.8), dvec3(1, 0, 0), -wo, dvec3(-wo.x, -wo.y, -wo.z)})
            EXPECT_EQ(evaluateLobe(c.lobe, {wo}, {wi})[0].f, dvec3(0)) << c.name;
}

TEST(Lobes, scaleWithReflectancePerChannel) {
    for (LobeCase c : finiteLobes()) {
        c.lobe.reflectance = {0.5f, 0.25f, 0};
        const dvec3 wo = outgoing(0.9), mirror(-wo.x, -wo.y, wo.z);
        const dvec3 f = evaluateLobe(c.lobe, {wo}, {mirror})[0].f;
        EXPECT_NEAR(f.x, 2 * f.y, 1e-6 * f.x) << c.name;
        EXPECT_EQ(f.z, 0) << c.name;
        EXPECT_GT(f.y, 0) << c.name;
    }
}

TEST(Lobes, albedoEstimateIsCloseEnoughToChooseByAndNeverZero) {
    const SampleGrid grid{0, 1, 0, 2 * pi, 10, 16};
    for (const LobeCase& c : finiteLobes())
        for (double cosine : outgoingCosines()) {
            const dvec3 wo = outgoing(cosine);
            double albedo = 0;
            for (const QuadraturePoint& p : gridQuadrature(grid, 24)) {
                const LobeDirection d = lobeDirection(c.lobe, wo, p.u, p.v);
                albedo += lobeFormula(c.lobe, wo, d.wi) * d.wi.z * d.solidAngle * p.weight;
            }
            const double ratio = lobeAlbedos(c.lobe, {wo})[0].y / albedo;
            // Microfacet lobes: the estimate leaves out shadowing.
            const double most = c.lobe.type == LOBE_PHONG ? 1.2 : c.lobe.type == LOBE_LAMBERT ? 1.001 : 3.5;
            EXPECT_GT(ratio, 0.85) << c.name << ", wo.z = " << cosine;
            EXPECT_LT(ratio, most) << c.name << ", wo.z = " << cosine;
        }
}

struct DielectricValue {
    double reflectance, cosT;
};

DielectricValue dielectric(float cosI, float eta) {
    static Program program = testProgram("lobes.cl", "-DHAS_LOBE_LAMBERT");
    Buffer<float> c(testDevice(), std::vector{cosI}, "cosine"), e(testDevice(), std::vector{eta}, "eta"),
        out(testDevice(), 2, "F");
    program.kernel("dielectricReflectance").launch(1, c, e, out, cl_uint(1));
    return {out.read()[0], out.read()[1]};
}

double conductor(float cosI, float eta, float k) {
    static Program program = testProgram("lobes.cl", "-DHAS_LOBE_LAMBERT");
    Buffer<float> c(testDevice(), std::vector{cosI}, "cosine"), e(testDevice(), std::vector{eta}, "eta");
    Buffer<float> ks(testDevice(), std::vector{k}, "k"), out(testDevice(), 1, "F");
    program.kernel("conductorReflectance").launch(1, c, e, ks, out, cl_uint(1));
    return out.read()[0];
}

/// Fresnel's amplitudes with a complex index, which covers total internal reflection and conductors.
double exactFresnel(double cosI, std::complex<double> index) {
    const std::complex<double> g = std::sqrt(index * index - (1 - cosI) * (1 + cosI));
    const auto rs = (cosI - g) / (cosI + g), rp = (index * index * cosI - g) / (index * index * cosI + g);
    return 0.5 * (std::norm(rs) + std::norm(rp));
}

TEST(Fresnel, dielectricMatchesComplexAmplitudesEverywhere) {
    for (float eta : {0.4f, 1 / 1.5f, 0.99f, 1.0001f, 1.33f, 1.5f, 2.4f})
        for (float cosI : {1.0f, 0.99f, 0.8f, 0.5f, 0.2f, 0.05f, 1e-3f}) {
            const double exact = exactFresnel(cosI, double(eta));
            EXPECT_NEAR(dielectric(cosI, eta).reflectance, exact, 1e-5 * exact + 1e-14) << eta << " at " << cosI;
        }
}

TEST(Fresnel, dielectricClosedForms) {
    EXPECT_NEAR(dielectric(1, 1.5f).reflectance, 0.04, 1e-8);
    const float brewster = float(std::cos(std::atan(1.5)));
    EXPECT_NEAR(dielectric(brewster, 1.5f).reflectance, 0.5 * std::pow((1.5 * 1.5 - 1) / (1.5 * 1.5 + 1), 2), 1e-7);
    EXPECT_EQ(dielectric(0.7f, 1 / 1.5f).reflectance, 1) << "total internal reflection must be exact";
    EXPECT_EQ(dielectric(0.7f, 1 / 1.5f).cosT, 0);
    for (float cosI : {1.0f, 0.5f, 1e-3f}) {
        EXPECT_EQ(dielectric(cosI, 1).reflectance, 0) << "no interface, no reflection";
        EXPECT_FLOAT_EQ(float(dielectric(cosI, 1).cosT), cosI);
    }
}

TEST(Fresnel, conductorMatchesComplexAmplitudes) {
    for (auto [eta, k] :
         {std::pair(0.2f, 3.9f), {1.37f, 7.6f}, {0.05f, 4.0f}, {2.8f, 3.1f}, {1.5f, 0.0f}, {1.5f, 0.01f}})
        for (float cosI : {1.0f, 0.8f, 0.5f, 0.2f, 0.05f, 1e-3f}) {
            const double exact = exactFresnel(cosI, {double(eta), double(k)});
            EXPECT_NEAR(conductor(cosI, eta, k), exact, 2e-6) << eta << " + " << k << "i at " << cosI;
        }
    for (float cosI : {1.0f, 0.5f, 1e-4f}) EXPECT_EQ(conductor(cosI, 0, 1), 1) << "the ideal mirror";
}

TEST(DeltaLobes, haveNoDensityAndNoValue) {
    const dvec3 wo = outgoing(0.5), mirror(-wo.x, -wo.y, wo.z);
    for (unsigned type : {LOBE_CONDUCTOR, LOBE_DIELECTRIC, LOBE_THINDIELECTRIC}) {
        const EvaluatedDirection value = evaluateLobe(makeLobe(type), {wo}, {mirror})[0];
        EXPECT_EQ(value.f, dvec3(0));
        EXPECT_EQ(value.pdf, 0);
    }
}

TEST(Conductor, reflectsLikeAMirrorWithFresnel) {
    shared::Lobe lobe = makeLobe(LOBE_CONDUCTOR);
    lobe.reflectance = {1, 0.5f, 0};
    lobe.eta = {0.2f, 0.2f, 0.2f};
    lobe.k = {3.9f, 3.9f, 3.9f};
    for (double cosine : outgoingCosines()) {
        const dvec3 wo = outgoing(cosine);
        const SampledDirection s = sampleLobe(lobe, wo, {0.5f, 0.5f, 0.5f})[0];
        EXPECT_TRUE(s.valid);
        EXPECT_EQ(s.wi, dvec3(-wo.x, -wo.y, wo.z));
        EXPECT_NEAR(s.weight.x, exactFresnel(wo.z, {double(0.2f), double(3.9f)}), 2e-6);
        EXPECT_NEAR(s.weight.y, 0.5 * s.weight.x, 1e-7);
        EXPECT_EQ(s.weight.z, 0);
        EXPECT_EQ(s.pdf, 0);
    }
}

shared::Lobe glass(float eta) {
    shared::Lobe lobe = makeLobe(LOBE_DIELECTRIC);
    lobe.eta = {eta, eta, eta};
    return lobe;
}

TEST(Dielectric, refractsBySnellAndSquareOfEtaScalesRadianceOnly) {
    for (float eta : {1.5f, 1 / 1.5f, 1.001f, 1.0f})
        for (double cosine : {1.0, 0.9, 0.8}) {
            const dvec3 wo = outgoing(cosine);
            const SampledDirection asFlux = sampleLobe(glass(eta), wo, {1 - 0x1p-24f, 0, 0}, flux)[0];
            const SampledDirection asRadiance = sampleLobe(glass(eta), wo, {1 - 0x1p-24f, 0, 0}, radiance)[0];
            EXPECT_LT(asFlux.wi.z, 0);
            EXPECT_NEAR(glm::length(asFlux.wi), 1, 2e-7);
            EXPECT_NEAR(glm::length(glm::dvec2(asFlux.wi) * double(eta) + glm::dvec2(wo)), 0, 2e-7) << "Snell";
            EXPECT_NEAR(asFlux.weight.y, 1, 1e-6) << "chosen by F, so nothing is left of it";
            EXPECT_NEAR(asRadiance.weight.y, 1 / (double(eta) * eta), 1e-6);
        }
}

TEST(Dielectric, choosesReflectionWithTheProbabilityOfFresnelTimesReflectance) {
    shared::Lobe lobe = glass(1.5f);
    lobe.reflectance = {0.5f, 0.5f, 0.5f};
    const dvec3 wo = outgoing(0.1);
    const double f = exactFresnel(wo.z, 1.5), probability = 0.5 * f / (0.5 * f + 1 - f);
    const SampledDirection reflected = sampleLobe(lobe, wo, {float(probability - 1e-5), 0, 0}, flux)[0];
    const SampledDirection refracted = sampleLobe(lobe, wo, {float(probability + 1e-5), 0, 0}, flux)[0];
    EXPECT_GT(reflected.wi.z, 0);
    EXPECT_LT(refracted.wi.z, 0);
    EXPECT_NEAR(reflected.weight.y * probability, 0.5 * f, 1e-6);
    EXPECT_NEAR(refracted.weight.y * (1 - probability), 1 - f, 1e-6);
    EXPECT_NEAR(lobeAlbedos(lobe, {wo})[0].y, 0.5 * f + 1 - f, 1e-6);
}

TEST(Dielectric, reflectsTotallyBeyondTheCriticalAngleAndNeverWhereThereIsNoInterface) {
    const dvec3 wo = outgoing(0.5);
    for (const SampledDirection& s : sampleLobe(glass(1 / 1.5f), wo, extremeNumbers(3), radiance)) {
        EXPECT_GT(s.wi.z, 0);
        EXPECT_EQ(s.weight, dvec3(1));
    }
    for (const SampledDirection& s : sampleLobe(glass(1), wo, extremeNumbers(3), radiance)) {
        EXPECT_NEAR(glm::length(s.wi + wo), 0, 2e-7);
        EXPECT_EQ(s.weight, dvec3(1));
    }
}

TEST(Dielectric, blackInterfaceEndsThePath) {
    shared::Lobe lobe = glass(1.5f);
    lobe.reflectance = lobe.transmittance = {0, 0, 0};
    for (const SampledDirection& s : sampleLobe(lobe, outgoing(0.5), extremeNumbers(3))) EXPECT_FALSE(s.valid);
}

/// Reflectance of a pane as the sum over the reflections between its two surfaces.
double paneBySeries(double cosI, double eta) {
    const double r = exactFresnel(cosI, eta);
    double sum = r, term = (1 - r) * r * (1 - r);
    for (int k = 0; k < 2000; ++k, term *= r * r) sum += term;
    return sum;
}

TEST(ThinDielectric, sharesLightAsTheSeriesOfReflectionsAndDoesNotBendIt) {
    shared::Lobe lobe = makeLobe(LOBE_THINDIELECTRIC);
    lobe.reflectance = {0.5f, 0.5f, 0.5f};
    for (float eta : {1.5f, 1.001f, 2.4f, 0.8f})
        for (double cosine : {1.0, 0.9, 0.7, 0.1, 0.01}) {
            lobe.eta = {eta, eta, eta};
            const dvec3 wo = outgoing(cosine);
            const double f = eta < 1 && wo.z < 0.6 ? 1 : paneBySeries(wo.z, double(eta));
            const double probability = 0.5 * f / (0.5 * f + 1 - f);
            EXPECT_NEAR(lobeAlbedos(lobe, {wo})[0].y, 0.5 * f + 1 - f, 1e-6);
            for (int transport : {radiance, flux}) {
                const SampledDirection reflected = sampleLobe(lobe, wo, {0, 0, 0}, transport)[0];
                EXPECT_EQ(reflected.wi, dvec3(-wo.x, -wo.y, wo.z));
                EXPECT_NEAR(reflected.weight.y * probability, 0.5 * f, 2e-6);
                const SampledDirection passed = sampleLobe(lobe, wo, {1 - 0x1p-24f, 0, 0}, transport)[0];
                if (f == 1) continue; // nothing passes
                EXPECT_EQ(passed.wi, -wo);
                EXPECT_NEAR(passed.weight.y * (1 - probability), 1 - f, 2e-6);
                EXPECT_EQ(passed.pdf, 0);
            }
        }
    lobe.reflectance = lobe.transmittance = {0, 0, 0};
    for (const SampledDirection& s : sampleLobe(lobe, outgoing(0.5), extremeNumbers(3))) EXPECT_FALSE(s.valid);
}

TEST(Pane, letsPassWhatTheSeriesOfReflectionsLeaves) {
    shared::Lobe lobe = makeLobe(LOBE_PANE);
    for (float eta : {1.5f, 1.001f, 2.4f})
        for (double cosine : {1.0, 0.9, 0.7, 0.1, 0.01}) {
            lobe.eta = {eta, eta, eta};
            lobe.transmittance = {0.25f, 0.5f, 1};
            const dvec3 wo = outgoing(cosine);
            const double passes = 1 - paneBySeries(wo.z, double(eta));
            EXPECT_NEAR(lobeAlbedos(lobe, {wo})[0].y, 0.5 * passes, 1e-6);
            for (int transport : {radiance, flux}) {
                const SampledDirection passed = sampleLobe(lobe, wo, {0.3f, 0.6f, 0.1f}, transport)[0];
                EXPECT_EQ(passed.wi, -wo);
                EXPECT_NEAR(passed.weight.x, 0.25 * passes, 1e-6);
                EXPECT_EQ(passed.pdf, 0);
            }
        }
}

} // namespace
} // namespace quasilux
