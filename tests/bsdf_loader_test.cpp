// What the bsdfs of a scene file mean: lobes, sides, widths, colours, indices of refraction.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::expectNear;
using test::loadShape;

constexpr double degree = 3.14159265358979324 / 180;

Scene load(const std::string& body) { return test::loadBody(body); }

Bsdf loadBsdf(const std::string& bsdf) { return load("<shape type=\"rectangle\">" + bsdf + "</shape>").bsdfs.at(0); }

void expectRgb(Rgb value, float r, float g, float b, float tolerance = 1e-6f) {
    expectNear({value.r, value.g, value.b}, {r, g, b}, tolerance);
}

TEST(DiffuseBsdf, OneSidedLambert) {
    const Bsdf bsdf = loadBsdf(R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.1, 0.2 0.3"/></bsdf>)");
    ASSERT_EQ(bsdf.front.size(), 1u);
    EXPECT_TRUE(bsdf.back.empty());
    expectRgb(bsdf.front[0].device.reflectance, 0.1f, 0.2f, 0.3f);
    EXPECT_NEAR(bsdf.front[0].halfWidth, 45 * degree, 1e-12);
    EXPECT_EQ(bsdf.front[0].device.scattering, 0u);
    EXPECT_EQ(bsdf.id, "diffuse@4");
}

TEST(Colors, EveryForm) {
    const auto reflectance = [](const std::string& element) {
        return loadBsdf("<bsdf type=\"diffuse\">" + element + "</bsdf>").front.at(0).device.reflectance;
    };
    expectRgb(reflectance(R"(<rgb name="reflectance" value="0.3"/>)"), 0.3f, 0.3f, 0.3f);
    expectRgb(reflectance(R"(<float name="reflectance" value="0.3"/>)"), 0.3f, 0.3f, 0.3f);
    expectRgb(reflectance(R"(<spectrum name="reflectance" value="0.3"/>)"), 0.3f, 0.3f, 0.3f);
    expectRgb(reflectance(R"(<rgb name="reflectance" value="#ff8000"/>)"), 1, 0.2158605f, 0);
    const auto radiance = [](const std::string& element) {
        return loadShape("<shape type=\"rectangle\"><emitter type=\"area\">" + element + "</emitter></shape>")
            .emitter.value()
            .radiance;
    };
    expectRgb(radiance(R"(<spectrum name="radiance" value="2"/>)"), 2.4095879f, 1.8965820f, 1.8178322f, 1e-5f);
    expectRgb(radiance(R"(<rgb name="radiance" value="2"/>)"), 2, 2, 2);
    expectRgb(radiance(""), 1, 1, 1);
}

TEST(PhongBsdf, LobesAndWidth) {
    const Bsdf bsdf = loadBsdf(R"(<bsdf type="phong"><float name="exponent" value="1000"/></bsdf>)");
    ASSERT_EQ(bsdf.front.size(), 2u);
    expectRgb(bsdf.front[0].device.reflectance, 0.5f, 0.5f, 0.5f);
    expectRgb(bsdf.front[1].device.reflectance, 0.2f, 0.2f, 0.2f);
    EXPECT_NEAR(std::pow(std::cos(bsdf.front[1].halfWidth), 1001), 0.5, 1e-9);
    const Bsdf pure = loadBsdf(R"(<bsdf type="phong"><rgb name="diffuse_reflectance" value="0"/></bsdf>)");
    ASSERT_EQ(pure.front.size(), 1u);
    EXPECT_EQ(pure.front[0].name, "specular");
}

TEST(RoughConductorBsdf, DistributionsAlphasAndMetals) {
    const LobeDescription plain = loadBsdf(R"(<bsdf type="roughconductor"/>)").front.at(0);
    EXPECT_EQ(plain.device.type, unsigned(LOBE_BECKMANN));
    EXPECT_FLOAT_EQ(plain.device.alphaU, 0.1f);
    expectRgb(plain.device.eta, 0, 0, 0); // material "none": Fresnel factor 1
    expectRgb(plain.device.k, 1, 1, 1);
    EXPECT_NEAR(std::tan(plain.halfWidth / 2), 0.1 * std::sqrt(std::log(2.0)), 1e-8);

    const LobeDescription gold =
        loadBsdf(
            R"(<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="Au"/>
        <float name="alpha_u" value="0.02"/><float name="alpha_v" value="0.3"/><boolean name="sample_visible" value="true"/></bsdf>)")
            .front.at(0);
    EXPECT_EQ(gold.device.type, unsigned(LOBE_GGX));
    EXPECT_FLOAT_EQ(gold.device.alphaU, 0.02f);
    EXPECT_FLOAT_EQ(gold.device.alphaV, 0.3f);
    EXPECT_NEAR(std::tan(gold.halfWidth / 2), 0.3, 1e-7);
    expectRgb(gold.device.eta, 0.143119f, 0.374957f, 1.442479f);
    expectRgb(gold.device.k, 3.983160f, 2.385721f, 1.603215f);

    const LobeDescription own =
        loadBsdf(R"(<bsdf type="roughconductor"><rgb name="eta" value="1,2,3"/><float name="k" value="4"/></bsdf>)")
            .front.at(0);
    expectRgb(own.device.eta, 1, 2, 3);
    expectRgb(own.device.k, 4, 4, 4);
}

TEST(ConductorBsdf, IsADeltaLobe) {
    const LobeDescription mirror =
        loadBsdf(R"(<bsdf type="conductor"><rgb name="specular_reflectance" value="0.9"/></bsdf>)").front.at(0);
    EXPECT_EQ(mirror.device.type, unsigned(LOBE_CONDUCTOR));
    EXPECT_EQ(mirror.device.scattering, SCATTER_SPECULAR);
    EXPECT_EQ(mirror.halfWidth, 0);
    expectRgb(mirror.device.reflectance, 0.9f, 0.9f, 0.9f);
}

// What a white base sends back and what the coat reflects is all light, from any direction: reflectance and the share that the coat lets
// in cancel.
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

TEST(DielectricBsdf, IndexIsRelativeToTheSideThatIsLookedFrom) {
    const Bsdf glass = loadBsdf(
        R"(<bsdf type="dielectric"><float name="int_ior" value="1.5"/><string name="ext_ior" value="water"/></bsdf>)");
    ASSERT_EQ(glass.front.size(), 1u);
    ASSERT_EQ(glass.back.size(), 1u);
    EXPECT_FLOAT_EQ(glass.front[0].device.eta.r, 1.5f / 1.333f);
    EXPECT_FLOAT_EQ(glass.back[0].device.eta.r, 1.333f / 1.5f);
    EXPECT_EQ(glass.back[0].device.scattering, SCATTER_SPECULAR);
    expectRgb(glass.front[0].device.transmittance, 1, 1, 1);
    EXPECT_FLOAT_EQ(loadBsdf(R"(<bsdf type="dielectric"/>)").front[0].device.eta.r, float(1.5046 / 1.000277));
}

TEST(DielectricBsdf, EqualIndicesAreAllowedWithAWarning) {
    const Scene scene = load(
        R"(<shape type="cube"><bsdf type="dielectric"><float name="int_ior" value="1"/><float name="ext_ior" value="1"/></bsdf></shape>)");
    EXPECT_FALSE(scene.bsdfs[0].isNull);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], testing::HasSubstr("int_ior and ext_ior are equal"));
}

TEST(RoughDielectricBsdf, HasTheIndexOfEachSideAndTheSameRoughness) {
    const Bsdf plain = loadBsdf(R"(<bsdf type="roughdielectric"/>)");
    ASSERT_EQ(plain.front.size(), 1u);
    ASSERT_EQ(plain.back.size(), 1u);
    EXPECT_EQ(plain.front[0].device.type, unsigned(LOBE_BECKMANNDIELECTRIC));
    EXPECT_FLOAT_EQ(plain.front[0].device.eta.r, float(1.5046 / 1.000277));
    EXPECT_FLOAT_EQ(plain.back[0].device.eta.r, float(1.000277 / 1.5046));
    EXPECT_FLOAT_EQ(plain.back[0].device.alphaV, 0.1f);
    EXPECT_NE(plain.front[0].device.scattering, SCATTER_SPECULAR) << "no delta lobe: the law decides by its width";
    // Photons from both sides meet at the surface, so both sides must be of the same kind by the law.
    EXPECT_EQ(plain.front[0].halfWidth, plain.back[0].halfWidth);
    EXPECT_NEAR(std::tan(plain.front[0].halfWidth / 2), 0.1 * std::sqrt(std::log(2.0)), 1e-8);

    const Bsdf all = loadBsdf(
        R"(<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha_u" value="0.02"/>
        <float name="alpha_v" value="0.3"/><string name="int_ior" value="water"/><float name="ext_ior" value="1.5"/>
        <boolean name="sample_visible" value="true"/><rgb name="specular_reflectance" value="0.9,0.8,0.7"/>
        <rgb name="specular_transmittance" value="0.6,0.5,0.4"/></bsdf>)");
    const LobeDescription& lobe = all.front.at(0);
    EXPECT_EQ(lobe.device.type, unsigned(LOBE_GGXDIELECTRIC));
    EXPECT_EQ(lobe.name, "specular");
    EXPECT_FLOAT_EQ(lobe.device.eta.r, 1.333f / 1.5f);
    EXPECT_FLOAT_EQ(lobe.device.alphaU, 0.02f);
    EXPECT_FLOAT_EQ(lobe.device.alphaV, 0.3f);
    EXPECT_NEAR(std::tan(lobe.halfWidth / 2), 0.3, 1e-7);
    expectRgb(lobe.device.reflectance, 0.9f, 0.8f, 0.7f);
    expectRgb(lobe.device.transmittance, 0.6f, 0.5f, 0.4f);
    expectRgb(all.back.at(0).device.transmittance, 0.6f, 0.5f, 0.4f);
}

TEST(BlendBsdf, WeightsTheSecondAndDropsWhatIsLeftBlack) {
    const std::string parts =
        R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.4"/></bsdf><bsdf type="dielectric"/></bsdf>)";
    const Bsdf quarter = loadBsdf(R"(<bsdf type="blendbsdf"><float name="weight" value="0.25"/>)" + parts);
    ASSERT_EQ(quarter.front.size(), 2u);
    ASSERT_EQ(quarter.back.size(), 1u);
    EXPECT_FLOAT_EQ(quarter.front[0].device.reflectance.g, 0.3f);
    EXPECT_FLOAT_EQ(quarter.front[1].device.reflectance.g, 0.25f);
    EXPECT_FLOAT_EQ(quarter.back[0].device.transmittance.g, 0.25f);
    const Bsdf first = loadBsdf(R"(<bsdf type="blendbsdf"><float name="weight" value="0"/>)" + parts);
    EXPECT_EQ(first.front.size(), 1u);
    EXPECT_TRUE(first.back.empty());
}

TEST(TwoSidedBsdf, SameOrDifferentSides) {
    const Bsdf same = loadBsdf(R"(<bsdf type="twosided"><bsdf type="phong"/></bsdf>)");
    EXPECT_EQ(same.front.size(), 2u);
    EXPECT_EQ(same.back.size(), 2u);
    const Bsdf two = loadBsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="conductor"/></bsdf>)");
    EXPECT_EQ(two.front.at(0).name, "diffuse");
    EXPECT_EQ(two.back.at(0).name, "specular");
}

TEST(DefaultBsdf, IsHalfGreyAndBlackOnEmitters) {
    const Scene scene =
        load(R"(<shape type="cube"/><shape type="sphere"/><shape type="rectangle"><emitter type="area"/></shape>)");
    ASSERT_EQ(scene.bsdfs.size(), 2u);
    EXPECT_EQ(scene.shapes[0].bsdf, scene.shapes[1].bsdf);
    expectRgb(scene.bsdfs[0].front.at(0).device.reflectance, 0.5f, 0.5f, 0.5f);
    EXPECT_TRUE(scene.bsdfs[1].front.empty());
}

TEST(Settings, TheInnermostBsdfDecides) {
    using Kind = QuasiSpecularChoice::Kind;
    const Bsdf bsdf = loadBsdf(R"(<bsdf type="blendbsdf"><?quasilux quasi-specular="no"?><bsdf type="diffuse"/>
        <bsdf type="roughconductor"><?quasilux quasi-specular="auto"?></bsdf></bsdf>)");
    EXPECT_EQ(bsdf.front.at(0).quasiSpecular.kind, Kind::no);
    EXPECT_EQ(bsdf.front.at(1).quasiSpecular.kind, Kind::automatic);
    EXPECT_TRUE(bsdf.front.at(1).quasiSpecular.stated);
    const Bsdf listed = loadBsdf(R"(<bsdf type="phong"><?quasilux quasi-specular="specular, diffuse"?></bsdf>)");
    EXPECT_THAT(listed.front.at(0).quasiSpecular.lobes, testing::ElementsAre("specular", "diffuse"));
}

} // namespace
} // namespace quasilux
