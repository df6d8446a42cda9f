// Emitters that emit nothing are left out with a warning, as scenes from the web have them, and a scene without light
// is black with one; Mitsuba's images are the same.
#include "prepare/device_scene.h"
#include "prepare/guide_tables.h"
#include "prepare/media.h"
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

size_t emittersOf(const Scene& scene) {
    size_t count = scene.pointEmitters.size() + scene.directionalEmitters.size() + (scene.surroundings ? 1 : 0);
    for (const ShapeDescription& shape : scene.shapes) count += shape.emitter.has_value();
    return count;
}

std::string of(const std::string& plugin, const std::string& content) {
    return "<emitter type=\"" + plugin + "\">" + content + "</emitter>";
}
std::string inShape(const std::string& emitter) { return "<shape type=\"rectangle\">" + emitter + "</shape>"; }

constexpr const char* blackTexture =
    R"(type="checkerboard"><rgb name="color0" value="0"/><rgb name="color1" value="0"/></texture>)";

const std::string offEmitters[] = {
    of("point", R"(<rgb name="intensity" value="0"/>)"),
    of("point", R"(<spectrum name="intensity" value="0"/>)"),
    of("spot", R"(<float name="intensity" value="0"/>)"),
    of("spot", std::string("<texture name=\"texture\" ") + blackTexture),
    of("projector", R"(<float name="scale" value="0"/>)"),
    of("projector", R"(<rgb name="irradiance" value="0"/>)"),
    of("directional", R"(<rgb name="irradiance" value="0,0,0"/>)"),
    of("constant", R"(<rgb name="radiance" value="0"/>)"),
    of("envmap", R"(<string name="filename" value="sky.ppm"/><float name="scale" value="0"/>)"),
    of("envmap", R"(<string name="filename" value="black.ppm"/>)"),
    of("sunsky", R"(<float name="sun_scale" value="0"/><float name="sky_scale" value="0"/>)"),
    inShape(of("area", R"(<rgb name="radiance" value="0"/>)")),
    inShape(of("area", std::string("<texture name=\"radiance\" ") + blackTexture)),
    inShape(of("directionalarea", R"(<rgb name="radiance" value="0"/>)")),
};

/// A file of 2 x 2 grey pixels.
void writePixels(const test::SceneFiles& files, const char* name, char value) {
    files.write(name, "P6\n2 2\n255\n" + std::string(12, value));
}

class OffEmitter : public testing::TestWithParam<std::string> {
protected:
    OffEmitter() {
        writePixels(files, "sky.ppm", 100);
        writePixels(files, "black.ppm", 0);
    }

    test::SceneFiles files;
};

TEST_P(OffEmitter, IsLeftOutWithAWarning) {
    const Scene scene = loadScene(files.write("scene.xml", test::sceneWith(GetParam())));
    EXPECT_EQ(emittersOf(scene), 1u) << "the point of the scene around it";
    EXPECT_THAT(scene.warnings,
                ElementsAre(testing::AllOf(HasSubstr("scene.xml:4:"), HasSubstr("is off: all that it emits is 0"))));
}

TEST_P(OffEmitter, LeavesASceneWithoutLight) {
    const Scene scene = loadScene(
        files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" + GetParam() + "</scene>"));
    EXPECT_EQ(emittersOf(scene), 0u);
    EXPECT_THAT(scene.warnings,
                ElementsAre(HasSubstr("is off"), HasSubstr("scene.xml: every emitter of the scene is off, so its image "
                                                           "is black")));
}
INSTANTIATE_TEST_SUITE_P(Kinds, OffEmitter, testing::ValuesIn(offEmitters));

// A red spot through a green picture: nothing says so but its power. Photons still begin somewhere, and bring nothing.
TEST(EmittersOff, WhatMultipliesToNothingIsChosenEvenly) {
    const std::string spot =
        of("spot", R"(<rgb name="intensity" value="1,0,0"/><texture name="texture" type="checkerboard">
        <rgb name="color0" value="0,1,0"/><rgb name="color1" value="0,1,0"/></texture>)");
    for (const unsigned count : {1u, 100u}) {
        std::string body;
        for (unsigned k = 0; k < count; ++k) body += spot;
        const test::SceneFiles files;
        const Scene scene = loadScene(
            files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" + body + "</scene>"));
        const EmitterTables tables = flattenEmitters(scene, placeMedia(scene));
        ASSERT_EQ(tables.emitters.size(), count);
        for (const auto& emitter : tables.emitters) EXPECT_FLOAT_EQ(emitter.selectionProbability, 1.0f / count);
        EXPECT_EQ(plainGuide(tables).leaves.size(), count);
    }
}

TEST(EmittersOff, OneChannelIsEnoughToBeOn) {
    const Scene scene = test::loadBody(of("point", R"(<rgb name="intensity" value="0,0,1"/>)"));
    EXPECT_EQ(emittersOf(scene), 2u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(EmittersOff, AShapeWithoutBsdfStaysBlack) {
    const Scene scene = test::loadBody(inShape(of("area", R"(<rgb name="radiance" value="0"/>)")));
    EXPECT_TRUE(scene.bsdfs.at(static_cast<size_t>(scene.shapes.at(0).bsdf)).front.empty()) << "as in Mitsuba";
}

TEST(EmittersOff, SurroundingsMayFollowOnesThatAreOff) {
    const Scene scene = test::loadBody(of("constant", R"(<rgb name="radiance" value="0"/>)") +
                                       of("constant", R"(<rgb name="radiance" value="2"/>)"));
    EXPECT_EQ(scene.surroundings.value().radiance.g, 2);
}

TEST(EmittersOff, NoneAtAllIsAWarning) {
    const auto warnings = [](const std::string& integrator) {
        const test::SceneFiles files;
        return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" +
                                                      integrator + "</scene>"))
            .warnings;
    };
    EXPECT_THAT(warnings(""), ElementsAre(testing::AllOf(HasSubstr("the scene has no emitter, so its image is black"),
                                                         testing::Not(HasSubstr("aov")))));
    EXPECT_THAT(warnings(R"(<integrator type="aov"><string name="aovs" value="d:depth"/></integrator>)"),
                ElementsAre(HasSubstr("The layers of the integrator 'aov' need no light.")));
}

TEST(EmittersOff, AreKeptInMindForHiding) {
    EXPECT_TRUE(test::loadShape(inShape(of("area", R"(<rgb name="radiance" value="0"/>)"))).emitterIsOff);
    EXPECT_FALSE(test::loadShape(inShape(of("area", R"(<rgb name="radiance" value="1"/>)"))).emitterIsOff);
    EXPECT_FALSE(test::loadShape("<shape type=\"rectangle\"/>").emitterIsOff);
}

// Mitsuba 3.9.1, beside a second emitter: the first five then light nothing, the others as ever.
TEST(EmittersOff, AreThoseThatOnlySamplesOfWeightZeroFind) {
    const std::string never = R"(<float name="sampling_weight" value="0"/>)";
    const std::string rarely = R"(<float name="sampling_weight" value="1e-3"/>)";
    for (const std::string plugin : {"point", "spot", "directional", "projector"}) {
        const std::string picture = plugin == "projector" ? R"(<rgb name="irradiance" value="1"/>)" : "";
        const Scene off = test::loadBody(of(plugin, picture + never));
        EXPECT_EQ(emittersOf(off), 1u) << plugin;
        EXPECT_THAT(off.warnings, ElementsAre(HasSubstr("is off: its sampling_weight is 0"))) << plugin;
        EXPECT_TRUE(off.withoutEffect.empty()) << plugin;
        const Scene on = test::loadBody(of(plugin, picture + rarely));
        EXPECT_EQ(emittersOf(on), 2u) << plugin;
        EXPECT_THAT(on.withoutEffect, ElementsAre("sampling_weight")) << plugin;
    }
    EXPECT_TRUE(test::loadShape(inShape(of("directionalarea", never))).emitterIsOff);
    for (const std::string& met : {of("constant", never), of("sunsky", never), inShape(of("area", never))})
        EXPECT_EQ(emittersOf(test::loadBody(met)), 2u) << met;
    const test::SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write(
                    "scene.xml", test::sceneWith(of("point", R"(<float name="sampling_weight" value="-1"/>)")))),
                HasSubstr("'sampling_weight' of emitter 'point' is -1; it must be at least 0"));
}

TEST(EmittersOff, NegativeOnesAreRefused) {
    test::SceneFiles files;
    EXPECT_THAT(
        test::errorOf(
            files.write("scene.xml", test::sceneWith(of("point", "\n<rgb name=\"intensity\" value=\"0,-1,0\"/>")))),
        HasSubstr("scene.xml:5:1: parameter 'intensity' of emitter 'point' is (0, -1, 0); no channel may be negative"));
}

} // namespace
} // namespace quasilux
