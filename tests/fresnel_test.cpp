// Fresnel and Snell at one interface and at two: clear slabs, the critical angle, and what a path carries through
// glass.
#include "bsdf/lobe_list.h"
#include "support/float_rounding.h"
#include "support/lobe_cases.h"
#include "support/lobe_coordinates.h"
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr int radiance = 0, flux = 1;      // TRANSPORT_*
constexpr float lastNumber = 1 - 0x1p-24f; // chooses refraction wherever there is any

struct Interface {
    double reflectance, cosT;
};

std::vector<Interface> interfaces(const std::vector<float>& cosI, const std::vector<float>& eta) {
    static Program program = testProgram("lobes.cl", "-DHAS_LOBE_LAMBERT");
    Buffer<float> c(testDevice(), cosI, "cosines"), e(testDevice(), eta, "etas"),
        out(testDevice(), 2 * cosI.size(), "reflectances");
    program.kernel("dielectricReflectance").launch(cosI.size(), c, e, out, cl_uint(cosI.size()));
    const auto values = out.read();
    std::vector<Interface> result;
    for (size_t i = 0; i < cosI.size(); ++i) result.push_back({values[2 * i], values[2 * i + 1]});
    return result;
}

Interface interface(float cosI, float eta) { return interfaces({cosI}, {eta})[0]; }

/// Transmittance of a clear slab: the sum over all reflections between its sides.
double slabTransmittance(float cosI, float eta) {
    const Interface in = interface(cosI, eta), out = interface(float(in.cosT), 1 / eta);
    const double passed = (1 - in.reflectance) * (1 - out.reflectance);
    return passed / (1 - out.reflectance * out.reflectance);
}

TEST(ClearSlab, transmitsWhatAllInternalReflectionsLeave) {
    // (1 - R) / (1 + R) with the unpolarised R, in double, to all digits given.
    struct Row {
        float eta;
        double degrees, transmittance;
    };
    const Row rows[] = {{1.5f, 0, 0.923076923077},   {1.5f, 15, 0.922927587128},  {1.5f, 30, 0.920265532519},
                        {1.5f, 45, 0.904326791459},  {1.5f, 60, 0.836232462710},  {1.5f, 75, 0.596092047799},
                        {1.5f, 80, 0.441229173374},  {1.5f, 85, 0.240079637835},  {1.5f, 89, 0.050318142800},
                        {1.33f, 0, 0.960670302286},  {1.33f, 45, 0.946431511789}, {1.33f, 75, 0.650946077274},
                        {1.33f, 85, 0.263640809125}, {1.52f, 0, 0.918318028033},  {1.52f, 45, 0.899253649348},
                        {1.52f, 75, 0.591450262985}, {1.52f, 85, 0.238448765705}, {2.4f, 0, 0.710059171598},
                        {2.4f, 45, 0.696616185578},  {2.4f, 75, 0.504015041566},  {2.4f, 85, 0.232895946226}};
    for (const Row& row : rows) {
        const float cosI = float(std::cos(row.degrees * std::numbers::pi / 180));
        // The cosine inside is rounded, which counts for most close to the critical angle.
        EXPECT_NEAR(slabTransmittance(cosI, row.eta), row.transmittance,
                    (2e-6 + 2e-8 / (cosI * cosI)) * row.transmittance)
            << row.eta << " at " << row.degrees;
    }
}

TEST(ClearSlab, looksTheSameFromInsideOut) {
    for (float eta : {1.0001f, 1.33f, 1.5f, 2.4f})
        for (float cosI : {1.0f, 0.7f, 0.3f, 0.05f}) {
            const Interface in = interface(cosI, eta), out = interface(float(in.cosT), 1 / eta);
            // 1 / eta is rounded, and so is the cosine inside.
            const double tolerance = 1e-6 + 2e-7 / (eta - 1) + 1e-7 / (cosI * cosI);
            EXPECT_NEAR(out.reflectance, in.reflectance, tolerance * in.reflectance) << eta << " at " << cosI;
            EXPECT_NEAR(out.cosT, cosI, 2e-6 / cosI) << eta << " at " << cosI;
        }
}

TEST(CriticalAngle, beyondItAllIsReflectedAndBeforeItNotAll) {
    for (double index : {1.0001, 1.33, 1.5, 2.4, 10.0}) {
        const float eta = float(1 / index);
        const auto critical = float(std::sqrt((1 - double(eta)) * (1 + double(eta))));
        // The cosine at which the kernel's own floats cross the angle may be a few roundings off.
        const double rounding = 2e-7 / (critical * critical);
        for (double x = rounding; x < 1; x *= 1.5) {
            const Interface beyond = interface(float(critical * (1 - x)), eta);
            ASSERT_EQ(beyond.reflectance, 1) << index << ", beyond by " << x;
            ASSERT_EQ(beyond.cosT, 0) << index << ", beyond by " << x;
            if (critical * (1 + x) > 1) continue;
            const Interface before = interface(float(critical * (1 + x)), eta);
            ASSERT_LT(before.reflectance, 1) << index << ", before by " << x;
            ASSERT_GT(before.cosT, 0) << index << ", before by " << x;
        }
        const Interface at = interface(critical, eta);
        EXPECT_LE(at.reflectance, 1);
        // There 1 - F falls as 4 g / c, g the root of the rounding.
        EXPECT_GT(at.reflectance, 1 - 4 * (index * index + 1) * std::sqrt(2 * rounding)) << index;
    }
}

shared::Lobe glass(float eta) {
    shared::Lobe lobe = makeLobe(LOBE_DIELECTRIC);
    lobe.eta = {eta, eta, eta};
    return lobe;
}

/// Cosines all over the hemisphere, and for eta < 1 close before the critical angle.
std::vector<double> cosinesThatPass(float eta) {
    std::vector<double> cosines{1, 0.999, 0.9, 0.8, 0.6, 0.3, 0.1, 0.01};
    if (eta >= 1) return cosines;
    const double critical = std::sqrt((1 - double(eta)) * (1 + double(eta)));
    std::erase_if(cosines, [&](double c) { return c < critical; });
    for (double x : {1e-4, 1e-2}) cosines.push_back(critical + x * (1 - critical));
    return cosines;
}

TEST(Snell, holdsInBothDirectionsUpToTheCriticalAngle) {
    for (float eta : {1.0001f, 1.33f, 1.5f, 2.4f, 1 / 1.0001f, 1 / 1.33f, 1 / 1.5f, 1 / 2.4f})
        for (double cosine : cosinesThatPass(eta)) {
            const dvec3 wo = outgoing(cosine);
            for (int transport : {radiance, flux}) {
                const SampledDirection s = sampleLobe(glass(eta), wo, {lastNumber, 0, 0}, transport)[0];
                ASSERT_LT(s.wi.z, 0) << eta << " at " << cosine;
                EXPECT_NEAR(glm::length(s.wi), 1, 3e-7);
                EXPECT_NEAR(glm::length(glm::dvec2(s.wi) * double(eta) + glm::dvec2(wo)), 0, 5e-7)
                    << eta << " at " << cosine;
                const double scale = transport == radiance ? 1 / (double(eta) * eta) : 1;
                EXPECT_NEAR(s.weight.y, scale, 2e-6 * scale) << eta << " at " << cosine;
            }
        }
}

TEST(Snell, throughGlassAndOutAgainNothingIsLeftButTheDirection) {
    for (float eta : {1.0001f, 1.33f, 1.5f, 2.4f})
        for (double cosine : cosinesThatPass(eta))
            for (int transport : {radiance, flux}) {
                const dvec3 wo = outgoing(cosine);
                const SampledDirection in = sampleLobe(glass(eta), wo, {lastNumber, 0, 0}, transport)[0];
                const dvec3 back = roundToFloat(-in.wi); // on the inside of the second side, which looks the same way
                const SampledDirection out = sampleLobe(glass(1 / eta), back, {lastNumber, 0, 0}, transport)[0];
                EXPECT_NEAR(in.weight.y * out.weight.y, 1, 2e-6) << eta << " at " << cosine;
                EXPECT_NEAR(glm::length(out.wi + wo), 0, 2e-6 / cosine) << eta << " at " << cosine;
            }
}

} // namespace
} // namespace quasilux
