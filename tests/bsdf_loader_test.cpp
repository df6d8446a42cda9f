// What the bsdfs of a scene file mean: lobes, sides, widths, colours, indices of refraction. Those with a coat:
// coated_bsdf_loader_test.
#include "scene/scene.h"

#include "support/loaded_bsdf.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::expectNear;
using test::expectRgb;
using test::loadBsdf;
using test::loadShape;

constexpr double degree = 3.14159265358979324 / 180;

Scene load(const std::string& body) { return test::loadBody(body); }

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

// As scenes from the web have it; Mitsuba takes the mean of the channels where it wants a number.
TEST(Numbers, MayBeColours) {
    const Bsdf rough = loadBsdf(R"(<bsdf type="roughconductor"><rgb name="alpha" value="0.1,0.2,0.6"/></bsdf>)");
    EXPECT_NEAR(rough.front.at(0).device.alphaU, 0.3, 1e-6);
    const Bsdf mask = loadBsdf(R"(<bsdf type="mask"><rgb name="opacity" value="1,0,0"/><bsdf type="diffuse"/></bsdf>)");
    EXPECT_THAT(mask.front, testing::Contains(testing::Field(
                                &LobeDescription::device,
                                testing::Field(&shared::Lobe::transmittance,
                                               testing::Field(&Rgb::r, testing::FloatNear(2.f / 3, 1e-6f))))));
}

TEST(RoughConductor, WhatMitsubaClampsIsTakenWithAWarning) {
    const Scene scene = load(R"(<shape type="rectangle"><bsdf type="roughconductor"><float name="alpha" value="0"/>
        <rgb name="eta" value="-0.05,4,5"/><rgb name="k" value="2,2,2"/></bsdf></shape>)");
    const auto& lobe = scene.bsdfs.at(0).front.at(0).device;
    EXPECT_FLOAT_EQ(lobe.alphaU, 1e-4f);
    expectRgb(lobe.eta, 0, 4, 5);
    EXPECT_THAT(scene.warnings,
                testing::IsSupersetOf({testing::HasSubstr("'alpha' is 0, which is taken as 0.0001"),
                                       testing::HasSubstr("'eta' of bsdf 'roughconductor' has a negative")}));
    const auto ofAlpha = [](const std::string& warning) { return warning.find("'alpha") != std::string::npos; };
    EXPECT_EQ(std::count_if(scene.warnings.begin(), scene.warnings.end(), ofAlpha), 1) << "one parameter, one warning";
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
    expectRgb(gold.device.eta, 0.143036f, 0.375307f, 1.442045f, 1e-5f);
    expectRgb(gold.device.k, 3.982997f, 2.385556f, 1.603359f, 1e-5f);

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

TEST(MaskBsdf, LetsTheRestPassStraightOn) {
    const Bsdf mask =
        loadBsdf(R"(<bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="diffuse"/></bsdf>)");
    ASSERT_EQ(mask.front.size(), 2u);
    EXPECT_EQ(mask.front[0].device.type, unsigned(LOBE_PASSAGE));
    EXPECT_EQ(mask.front[0].device.scattering, SCATTER_SPECULAR);
    EXPECT_FLOAT_EQ(mask.front[0].device.transmittance.g, 0.75f);
    EXPECT_FLOAT_EQ(mask.front[1].device.reflectance.g, 0.125f);
    ASSERT_EQ(mask.back.size(), 1u) << "from behind only what passes";
    EXPECT_FLOAT_EQ(mask.back[0].device.transmittance.g, 0.75f);
    EXPECT_TRUE(mask.letsPass());
    EXPECT_FALSE(mask.isNull);
    EXPECT_FLOAT_EQ(loadBsdf(R"(<bsdf type="mask"><bsdf type="diffuse"/></bsdf>)").front[0].device.transmittance.g,
                    0.5f);
    const Bsdf opaque = loadBsdf(R"(<bsdf type="mask"><float name="opacity" value="1"/><bsdf type="diffuse"/></bsdf>)");
    EXPECT_FALSE(opaque.letsPass());
    EXPECT_TRUE(loadBsdf(R"(<bsdf type="mask"><bsdf type="null"/></bsdf>)").isNull);
}

TEST(MaskBsdf, TextureOfNumbersWeighsEveryLobe) {
    const Scene scene = load(R"(<shape type="rectangle"><bsdf type="mask">
        <texture type="checkerboard" name="opacity"><rgb name="color0" value="0.9,0.3,0"/></texture>
        <bsdf type="blendbsdf"><texture type="checkerboard" name="weight"/><bsdf type="diffuse"/><bsdf type="dielectric"/>
        </bsdf></bsdf></shape>)");
    const Bsdf& bsdf = scene.bsdfs.at(0);
    ASSERT_EQ(bsdf.front.size(), 3u);
    const auto& passage = bsdf.front[0].weights;
    ASSERT_EQ(passage.size(), 1u);
    EXPECT_EQ(passage[0].offset, 1);
    EXPECT_EQ(passage[0].factor, -1);
    // The mean of the channels; squares of numbers change places, as in Mitsuba 3.9.
    expectRgb(scene.textures.at(passage[0].texture).device.color1, 0.4f, 0.4f, 0.4f);
    expectRgb(scene.textures.at(passage[0].texture).device.color0, 0.2f, 0.2f, 0.2f);
    ASSERT_EQ(bsdf.front[1].weights.size(), 2u);
    EXPECT_EQ(bsdf.front[1].weights[0].factor, -1); // of the blend: the first is what is left
    EXPECT_EQ(bsdf.front[2].weights[0].factor, 1);
    EXPECT_EQ(bsdf.front[2].weights[1].factor, 1); // of the mask
    EXPECT_TRUE(bsdf.isTextured());
}

TEST(ThinDielectricBsdf, LetsLightPassByALobeOfItsOwn) {
    const std::string pane = R"(<bsdf type="thindielectric"><rgb name="specular_reflectance" value="0.5,0.5,0.5"/>
        <texture type="checkerboard" name="specular_transmittance"/></bsdf>)";
    const Bsdf bsdf = loadBsdf(pane);
    for (const auto& side : {bsdf.front, bsdf.back}) {
        ASSERT_EQ(side.size(), 2u);
        EXPECT_EQ(side[0].device.type, unsigned(LOBE_THINDIELECTRIC));
        EXPECT_FLOAT_EQ(side[0].device.reflectance.g, 0.5f);
        EXPECT_FLOAT_EQ(side[0].device.transmittance.g, 0);
        EXPECT_EQ(side[1].device.type, unsigned(LOBE_PANE));
        EXPECT_FLOAT_EQ(side[1].device.reflectance.g, 0);
        EXPECT_FLOAT_EQ(side[1].device.transmittance.g, 1);
        EXPECT_EQ(side[1].device.reflectanceTexture, side[1].device.transmittanceTexture);
        EXPECT_EQ(side[1].device.transmittanceTexture, 1u);
        EXPECT_EQ(side[1].device.eta.r, side[0].device.eta.r);
    }
    EXPECT_TRUE(bsdf.letsPass());
    const Bsdf bent =
        loadBsdf(R"(<bsdf type="normalmap"><texture type="checkerboard" name="normalmap"/>)" + pane + "</bsdf>");
    ASSERT_EQ(bent.front.size(), 1u) << "shadow rays do not know its normal";
    EXPECT_FALSE(bent.letsPass());
}

TEST(BlendBsdf, NullPasses) {
    const Bsdf bsdf = loadBsdf(
        R"(<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="null"/><bsdf type="diffuse"/></bsdf>)");
    ASSERT_EQ(bsdf.front.size(), 2u);
    EXPECT_EQ(bsdf.front[0].device.type, unsigned(LOBE_PASSAGE));
    EXPECT_FLOAT_EQ(bsdf.front[0].device.transmittance.g, 0.6f);
    EXPECT_FLOAT_EQ(bsdf.front[1].device.reflectance.g, 0.2f);
}

TEST(NormalMapBsdf, BendsTheNormalsOfItsMaterial) {
    const std::string board = R"(<texture type="checkerboard" name="normalmap"/>)";
    const Bsdf map = loadBsdf("<bsdf type=\"normalmap\">" + board + "<bsdf type=\"dielectric\"/></bsdf>");
    ASSERT_TRUE(map.frontRelief && map.backRelief);
    EXPECT_EQ(map.frontRelief->type, RELIEF_NORMALS);
    EXPECT_EQ(map.frontRelief->texture, 0u);
    EXPECT_EQ(map.frontRelief->flags, RELIEF_FLIPS | RELIEF_SHADOWS);
    EXPECT_EQ(map.backRelief->flags, RELIEF_FLIPS | RELIEF_SHADOWS);
    EXPECT_TRUE(map.isTextured());
    const Bsdf both = loadBsdf("<bsdf type=\"mask\"><bsdf type=\"twosided\"><bsdf type=\"normalmap\">" + board +
                               R"(<boolean name="flip_invalid_normals" value="false"/>
        <boolean name="use_shadowing_function" value="false"/><bsdf type="diffuse"/></bsdf></bsdf></bsdf>)");
    EXPECT_EQ(both.frontRelief.value().flags, 0u);
    EXPECT_EQ(both.backRelief.value().flags, RELIEF_MIRRORED);
}

TEST(NormalMapBsdf, TakesAColourThatIsTheSameEverywhere) {
    for (const std::string normals :
         {R"(<rgb name="normalmap" value="0.6,0.5,1"/>)",
          R"(<spectrum name="normalmap" type="srgb"><rgb name="color" value="0.6,0.5,1"/></spectrum>)"}) {
        const Scene scene = load("<shape type=\"rectangle\"><bsdf type=\"normalmap\">" + normals +
                                 "<bsdf type=\"diffuse\"/></bsdf></shape>");
        const auto& texture = scene.textures.at(scene.bsdfs.at(0).frontRelief.value().texture).device;
        expectRgb(texture.color0, 0.6f, 0.5f, 1);
        expectRgb(texture.color1, 0.6f, 0.5f, 1);
    }
}

TEST(BumpMapBsdf, TakesNumbersOfABitmap) {
    test::SceneFiles files;
    const auto file = files.write("bumps.ppm", "P3\n1 1\n255\n255 0 0\n");
    const Scene scene = load(R"(<shape type="rectangle"><bsdf type="bumpmap"><float name="scale" value="-2"/>
        <texture type="bitmap" name="arbitrary"><boolean name="raw" value="true"/><string name="filename" value=")" +
                             file + R"("/></texture><bsdf type="diffuse"/></bsdf></shape>)");
    const auto& relief = scene.bsdfs.at(0).frontRelief.value();
    EXPECT_EQ(relief.type, RELIEF_HEIGHTS);
    EXPECT_EQ(relief.scale, -2);
    EXPECT_NEAR(scene.textures.at(relief.texture).texels.at(0).b, 0.2127f, 1e-4f); // its luminance
}

// They are lengths, not reflectances: of any size and sign.
TEST(BumpMapBsdf, TakesHeightsAsTheyAre) {
    test::SceneFiles files;
    const float heights[] = {-0.25f, 5};
    std::string image = "Pf\n2 1\n-1\n";
    image.append(reinterpret_cast<const char*>(heights), sizeof heights);
    const Scene scene =
        load(R"(<shape type="rectangle"><bsdf type="bumpmap"><texture type="bitmap" name="any">
        <string name="filename" value=")" +
             files.write("heights.pfm", image) + R"("/></texture><bsdf type="diffuse"/></bsdf></shape>)");
    const auto& texels = scene.textures.at(scene.bsdfs.at(0).frontRelief.value().texture).texels;
    ASSERT_EQ(texels.size(), 2u);
    EXPECT_EQ(texels.at(0).r, -0.25f);
    EXPECT_EQ(texels.at(1).r, 5);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(PrincipledBsdf, IsASumOfLobes) {
    const Bsdf plain = loadBsdf(R"(<bsdf type="principled"/>)");
    ASSERT_EQ(plain.front.size(), 2u);
    EXPECT_TRUE(plain.back.empty());
    EXPECT_EQ(plain.front[0].device.type, unsigned(LOBE_PRINCIPLEDDIFFUSE));
    EXPECT_FLOAT_EQ(plain.front[0].device.alphaU, 0.5f);
    EXPECT_EQ(plain.front[1].device.type, unsigned(LOBE_GGX));
    EXPECT_FLOAT_EQ(plain.front[1].device.alphaU, 0.25f);
    EXPECT_NEAR(plain.front[1].device.eta.r, 1.5f, 1e-6f);

    const Bsdf all = loadBsdf(R"(<bsdf type="principled"><rgb name="base_color" value="0.8,0.4,0.1"/>
        <float name="metallic" value="0.25"/><float name="spec_trans" value="0.5"/><float name="eta" value="1.4"/>
        <float name="spec_tint" value="0.5"/><float name="sheen" value="0.4"/><float name="sheen_tint" value="1"/>
        <float name="clearcoat" value="0.3"/><float name="clearcoat_gloss" value="1"/><float name="anisotropic" value="1"/>
        </bsdf>)");
    ASSERT_EQ(all.front.size(), 5u);
    expectRgb(all.front[0].device.reflectance, 0.8f * 0.375f, 0.4f * 0.375f, 0.1f * 0.375f);
    const float luminance = 0.212671f * 0.8f + 0.715160f * 0.4f + 0.072169f * 0.1f;
    EXPECT_EQ(all.front[1].name, "sheen");
    EXPECT_NEAR(all.front[1].device.reflectance.r, 0.4f * 0.75f * 0.8f / luminance, 1e-5f);
    const auto& glass = all.front[2].device;
    EXPECT_EQ(glass.type, unsigned(LOBE_GGXDIELECTRIC));
    EXPECT_FLOAT_EQ(glass.reflectance.r, 0.375f);
    EXPECT_NEAR(glass.transmittance.g, 0.375f * std::sqrt(0.4f), 1e-6f);
    EXPECT_NEAR(glass.alphaU / glass.alphaV, 10, 1e-4);
    const auto& metal = all.front[3].device;
    EXPECT_EQ(metal.type, unsigned(LOBE_GGXSCHLICK));
    EXPECT_FLOAT_EQ(metal.k.r, 0.25f + 0.375f);
    EXPECT_NEAR(metal.eta.r, 0.25f * 0.8f + 0.375f * 0.8f / luminance / 36, 1e-5f);
    EXPECT_EQ(all.front[4].name, "clearcoat");
    EXPECT_FLOAT_EQ(all.front[4].device.alphaU, 0.001f);
    ASSERT_EQ(all.back.size(), 1u);
    EXPECT_FLOAT_EQ(all.back[0].device.reflectance.r, 0.375f);
    EXPECT_FLOAT_EQ(all.back[0].device.eta.r, 1 / 1.4f);

    const Bsdf metallic = loadBsdf(R"(<bsdf type="principled"><texture type="checkerboard" name="base_color"/>
        <float name="metallic" value="1"/></bsdf>)");
    ASSERT_EQ(metallic.front.size(), 2u) << "the colour fades towards grazing incidence";
    EXPECT_EQ(metallic.front[0].device.reflectanceTexture, 1u);
    EXPECT_EQ(metallic.front[1].device.reflectanceTexture, 0u);
}

std::string number(const std::string& name, double value) {
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
}

// As Mitsuba 3.9 takes them: an index below 1, and for light that passes one of 1 is a little more.
TEST(PrincipledBsdf, TakesEveryIndexAboveZero) {
    const auto principled = [](const std::string& name, double value, double transmitted) {
        return loadBsdf("<bsdf type=\"principled\">" + number(name, value) + number("spec_trans", transmitted) +
                        "</bsdf>");
    };
    EXPECT_FLOAT_EQ(principled("eta", 0.8, 0).front.at(1).device.eta.r, 0.8f);
    EXPECT_EQ(principled("eta", 1, 0).front.size(), 1u) << "no index, no reflection";
    const Bsdf thinner = principled("eta", 0.8, 1);
    EXPECT_FLOAT_EQ(thinner.front.back().device.eta.r, 0.8f);
    EXPECT_FLOAT_EQ(thinner.back.at(0).device.eta.r, 1.25f);
    EXPECT_FLOAT_EQ(principled("eta", 1, 1).front.back().device.eta.r, 1.001f);
    EXPECT_NEAR(principled("specular", 0, 1).front.back().device.eta.r, 2 / (1 - std::sqrt(0.08e-3)) - 1, 1e-6);
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
