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

TEST(Lenient, WhatIsKnownAndWrongRemainsAnError) {
    SceneFiles files;
    const std::string scene =
        files.write("scene.xml", sceneWith("<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>"));
    EXPECT_THROW(loadScene(scene, {}, {{}, Unknown::forgiven}), InputError);
}

TEST(Lenient, AKnownSceneIsTheSame) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", sceneWith("<shape type=\"cube\"/>"));
    EXPECT_TRUE(loadScene(path, {}, {{}, Unknown::forgiven}).warnings.empty());
}

} // namespace
} // namespace quasilux
