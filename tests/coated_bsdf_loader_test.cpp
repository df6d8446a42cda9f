// What plastics of a scene file mean: a diffuse base under a coat, smooth or rough.
#include "scene/bsdfs/rough_coat.h"

#include "support/loaded_bsdf.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::expectRgb;
using test::loadBsdf;

// What a white base sends back and what the coat reflects is all light, from any direction: reflectance and the share
// that the coat lets in cancel.
TEST(PlasticBsdf, AWhiteBaseLosesNothing) {
    const auto lobes = [](const std::string& parameters) {
        return loadBsdf("<bsdf type=\"plastic\"><float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" "
                        "value=\"1\"/>" +
                        parameters + "</bsdf>")
            .front;
    };
    const auto white = lobes(R"(<rgb name="diffuse_reflectance" value="1"/>)");
    ASSERT_EQ(white.size(), 2u);
    EXPECT_EQ(white[0].name, "diffuse");
    EXPECT_EQ(white[0].device.type, unsigned(LOBE_COATEDLAMBERT));
    EXPECT_NEAR(white[0].device.reflectance.g * white[0].device.exponent, 1, 1e-6);
    EXPECT_EQ(white[1].device.type, unsigned(LOBE_CONDUCTOR));
    EXPECT_EQ(white[1].device.scattering, SCATTER_SPECULAR);
    expectRgb(white[1].device.eta, 1.5f, 1.5f, 1.5f);
    expectRgb(white[1].device.k, 0, 0, 0);
    // The coat of index 1.5 sends back 0.5963 of diffuse light from inside (Egan & Hilgeman 1973).
    const double within = 0.5963, linear = 0.25 / (2.25 * (1 - within)),
                 nonlinear = 0.25 / (2.25 * (1 - 0.25 * within));
    const std::string grey = R"(<rgb name="diffuse_reflectance" value="0.25"/>)";
    EXPECT_NEAR(lobes(grey)[0].device.reflectance.g, linear, 2e-4);
    EXPECT_NEAR(lobes(grey + R"(<boolean name="nonlinear" value="true"/>)")[0].device.reflectance.g, nonlinear, 2e-4);
}

TEST(RoughPlasticBsdf, BaseUnderARoughCoat) {
    const auto lobes = [](const std::string& parameters) {
        return loadBsdf(
                   R"(<bsdf type="roughplastic"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>)" +
                   parameters + "</bsdf>")
            .front;
    };
    const auto plain = lobes("");
    ASSERT_EQ(plain.size(), 2u);
    EXPECT_EQ(plain[0].device.type, unsigned(LOBE_ROUGHCOATEDLAMBERT));
    EXPECT_EQ(plain[1].device.type, unsigned(LOBE_BECKMANN));
    EXPECT_FLOAT_EQ(plain[1].device.alphaV, 0.1f);
    EXPECT_NE(plain[1].device.scattering, SCATTER_SPECULAR);
    expectRgb(plain[1].device.eta, 1.5f, 1.5f, 1.5f);
    expectRgb(plain[1].device.k, 0, 0, 0);
    // A nearly smooth coat lets in what a smooth one does: all but Fresnel's share, of diffuse light 1 - 0.0918.
    const auto smooth = lobes(R"(<float name="alpha" value="0.01"/>)")[0].device;
    const auto transmitted = [&](double cosine) {
        double sum = 0;
        const double x = cosine / (cosine + double(smooth.alphaU));
        for (int k = 7; k >= 0; --k) sum = sum * x + double(smooth.coat[k]);
        return sum;
    };
    EXPECT_NEAR(transmitted(1), 0.96, 0.003);
    EXPECT_NEAR(transmitted(0.5), 1 - 0.0892, 0.003);
    EXPECT_NEAR(smooth.exponent, 1 - 0.0918, 0.004);
    // What goes to and fro below the coat, 0.59 of diffuse light, is coloured each time.
    const std::string grey = R"(<float name="alpha" value="0.01"/><rgb name="diffuse_reflectance" value="0.25"/>)";
    const double linear = lobes(grey)[0].device.reflectance.g,
                 nonlinear = lobes(grey + R"(<boolean name="nonlinear" value="true"/>)")[0].device.reflectance.g;
    const double within = 1 - 0.25 / (2.25 * linear);
    EXPECT_NEAR(within, 0.5963, 0.012);
    EXPECT_NEAR(nonlinear, 0.25 / (2.25 * (1 - 0.25 * within)), 1e-5);
}

// Below an index of 1 nothing is let in up to a critical angle, whose edge is the sharper the smoother the coat.
TEST(RoughPlasticBsdf, CoatsUnderDenserMediaAreFitted) {
    for (const double eta : {1 / 2.4, 1 / 1.5, 0.75, 0.9})
        for (const bool ggx : {false, true})
            for (const double alpha : {0.01, 0.1, 0.3, 1.0}) {
                SCOPED_TRACE(fmt::format("eta {}, {}, alpha {}", eta, ggx ? "ggx" : "beckmann", alpha));
                const RoughCoat coat{ggx, alpha, eta};
                const CoatFit fit = fitTransmission(coat);
                double worst = 0, mean = 0;
                for (int k = 0; k < 200; ++k) {
                    const double cosine = (k + 0.5) / 200, error = std::abs(fit(cosine) - coat.transmitted(cosine));
                    EXPECT_GE(fit(cosine), 0);
                    worst = std::max(worst, error);
                    mean += 2 * cosine * error / 200;
                }
                EXPECT_LT(worst, 0.03);
                for (const double factor : fit.factors)
                    EXPECT_LT(std::abs(factor), fit.edge > 0 ? 10 : 50'000) << "cancels, too much for floats";
                EXPECT_LT(mean, 0.007);
            }
    // Control: by the variable of other coats.
    const CoatFit wrong = fitTransmission({false, 0.1, 1.5});
    EXPECT_GT(std::abs(wrong(0.5) - RoughCoat{false, 0.1, 1 / 1.5}.transmitted(0.5)), 0.5);
    const auto low = loadBsdf(R"(<bsdf type="roughplastic"><float name="int_ior" value="1"/>
        <float name="ext_ior" value="1.5"/></bsdf>)")
                         .front[0]
                         .device;
    EXPECT_NE(low.alphaV, 0);
    EXPECT_FLOAT_EQ(low.eta.r, 1 / 1.5f);
}

} // namespace
} // namespace quasilux
