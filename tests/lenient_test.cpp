// What is unknown in a scene is an error, or with Unknown::forgiven the nearest thing that is known, listed once.
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::SceneFiles;
using test::sceneWith;
using testing::ElementsAre;
using testing::HasSubstr;

Scene loadLeniently(const std::string& body) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", sceneWith(body));
    test::errorOf(path); // an error unless it is forgiven
    return loadScene(path, {}, {{}, Unknown::forgiven});
}

float greyOf(const Scene& scene) { return scene.bsdfs.at(0).front.at(0).device.reflectance.g; }

TEST(Lenient, AnUnknownBsdfIsGrey) {
    const Scene scene =
        loadLeniently("<shape type=\"cube\">\n<bsdf type=\"velvet\"><float name=\"fuzz\" value=\"1\"/></bsdf></shape>");
    EXPECT_EQ(scene.bsdfs.at(0).front.at(0).device.type, unsigned(LOBE_LAMBERT));
    EXPECT_EQ(greyOf(scene), 0.5f);
    EXPECT_THAT(scene.warnings,
                ElementsAre(HasSubstr("1 thing is unknown"),
                            HasSubstr("scene.xml:5:1: unknown bsdf plugin 'velvet'. It is a grey diffuse")));
}

TEST(Lenient, AnUnknownBsdfWithinAnotherOneIsGrey) {
    const Scene scene =
        loadLeniently("<shape type=\"cube\"><bsdf type=\"twosided\">\n<bsdf type=\"velvet\"/></bsdf></shape>");
    EXPECT_EQ(scene.bsdfs.at(0).back.size(), 1u);
}

TEST(Lenient, AnUnknownTextureIsAHalf) {
    const Scene scene = loadLeniently("<shape type=\"cube\"><bsdf type=\"diffuse\">\n<texture type=\"marble\" "
                                      "name=\"reflectance\"/></bsdf></shape><texture type=\"wood\" id=\"idle\"/>");
    EXPECT_EQ(greyOf(scene), 0.5f);
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_THAT(scene.warnings,
                testing::Contains(HasSubstr("scene.xml:5:1: unknown texture plugin 'marble'. It is 0.5")));
}

TEST(Lenient, UnknownShapesAndEmittersAreLeftOut) {
    const Scene scene =
        loadLeniently("<shape type=\"teapot\"/>\n<emitter type=\"laser\"/>\n<shape type=\"cube\"><emitter "
                      "type=\"glow\"/></shape>");
    ASSERT_EQ(scene.shapes.size(), 1u);
    EXPECT_FALSE(scene.shapes[0].emitter.has_value());
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("3 things are unknown"),
                                            HasSubstr("scene.xml:4:1: unknown shape plugin 'teapot'"),
                                            HasSubstr("scene.xml:5:1: unknown emitter plugin 'laser'. It is left out."),
                                            HasSubstr("scene.xml:6:20: unknown emitter plugin 'glow'")));
}

TEST(Lenient, UnknownMediaAreEmptyAndPhasesIsotropic) {
    const Scene scene = loadLeniently(
        "<shape type=\"sphere\"><medium type=\"cloud\" name=\"interior\"/></shape><shape type=\"sphere\"><medium "
        "type=\"homogeneous\" name=\"interior\"><phase type=\"mie\"/></medium></shape>");
    EXPECT_EQ(scene.media.at(0).sigmaT.g, 0);
    EXPECT_EQ(scene.media.at(1).phase, unsigned(PHASE_ISOTROPIC));
}

TEST(Lenient, UnknownParametersObjectsAndElementsAreIgnored) {
    const Scene scene =
        loadLeniently("<shape type=\"cube\">\n<float name=\"bevel\" value=\"1\"/>\n<film type=\"hdrfilm\"/>\n"
                      "<volume type=\"gridvolume\" name=\"x\"/>\n<bsdf type=\"phong\"><texture "
                      "type=\"checkerboard\" name=\"exponent\"/></bsdf></shape>");
    ASSERT_EQ(scene.shapes.size(), 1u);
    EXPECT_EQ(scene.bsdfs.at(0).front.at(1).device.exponent, 30);
    ASSERT_EQ(scene.warnings.size(), 5u);
    EXPECT_THAT(scene.warnings,
                testing::Contains(HasSubstr("scene.xml:5:1: unknown parameter 'bevel' of shape 'cube'")));
    EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("scene.xml:6:1: shape 'cube' takes no <film>")));
    EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("scene.xml:7:1: shape 'cube' takes no <volume>")));
    EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("takes no texture as 'exponent'")));
}

std::string bsdf(const std::string& content) { return "<shape type=\"rectangle\">\n" + content + "</shape>"; }

// Some values of every kind that has a nearest one.
TEST(Lenient, ValuesOutOfRangeBecomeTheNearest) {
    const auto reflectance = [](const std::string& value) {
        return loadLeniently(bsdf("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + value + "\"/></bsdf>"))
            .bsdfs.at(0)
            .front.at(0)
            .device.reflectance;
    };
    EXPECT_EQ(reflectance("0.5,1.5,-1").r, 0.5f);
    EXPECT_EQ(reflectance("0.5,1.5,-1").g, 1);
    EXPECT_EQ(reflectance("0.5,1.5,-1").b, 0);
    const Scene rough =
        loadLeniently(bsdf("<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"phong\"/></bsdf>"));
    EXPECT_EQ(rough.bsdfs.at(0).front.at(0).device.type, unsigned(LOBE_BECKMANN));
    const Scene metallic =
        loadLeniently(bsdf("<bsdf type=\"principled\">\n<float name=\"metallic\" value=\"1.5\"/></bsdf>"));
    EXPECT_THAT(metallic.warnings,
                ElementsAre(HasSubstr("1 thing is unknown or out of range"),
                            HasSubstr("scene.xml:6:1: parameter 'metallic' of bsdf 'principled' is 1.5; it must lie "
                                      "within [0, 1]. It is taken as 1.")));
    EXPECT_EQ(
        loadLeniently("<emitter type=\"sunsky\"><float name=\"turbidity\" value=\"30\"/></emitter>").warnings.size(),
        2u);
    EXPECT_EQ(loadLeniently("<shape type=\"sphere\"><medium type=\"homogeneous\" name=\"interior\"><float "
                            "name=\"scale\" value=\"-2\"/></medium></shape>")
                  .media.at(0)
                  .sigmaT.g,
              0);
}

TEST(Lenient, OtherIntegratorsAndSamplersStandForPath) {
    const Scene scene = loadLeniently("<integrator type=\"depth\"/>");
    EXPECT_EQ(scene.maxDepth, -1);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("1 thing is unknown"),
                                            HasSubstr("scene.xml:4:1: integrator 'depth' is not supported: it draws "
                                                      "distances")));
    loadLeniently("<sensor type=\"perspective\"><sampler type=\"dice\"/></sensor>");
}

TEST(Lenient, WhatIsKnownAndHasNoNearestValueRemainsAnError) {
    SceneFiles files;
    for (const char* wrong :
         {"<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>",
          "<shape type=\"obj\"><string name=\"filename\" value=\"none.obj\"/></shape>", "<sensor type=\"pinhole\"/>"})
        EXPECT_THROW(loadScene(files.write("scene.xml", sceneWith(wrong)), {}, {{}, Unknown::forgiven}), InputError)
            << wrong;
}

TEST(Lenient, AKnownSceneIsTheSame) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", sceneWith("<shape type=\"cube\"/>"));
    EXPECT_TRUE(loadScene(path, {}, {{}, Unknown::forgiven}).warnings.empty());
}

} // namespace
} // namespace quasilux
