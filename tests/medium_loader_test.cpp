// What a scene file says of media: values, defaults, phase functions, sharing, where they stand; and what is refused.
#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::loadBody;
using test::SceneFiles;
using test::sceneWith;
using testing::ElementsAre;
using testing::HasSubstr;

/// The medium inside of a cube.
MediumDescription loadMedium(const std::string& content) {
    return loadBody("<shape type=\"cube\"><medium type=\"homogeneous\" name=\"interior\">" + content +
                    "</medium></shape>")
        .media.at(0);
}

void expectRgb(Rgb value, float r, float g, float b) {
    test::expectNear({value.r, value.g, value.b}, {r, g, b}, 1e-6f);
}

TEST(Medium, DefaultsAreThoseOfMitsuba) {
    const MediumDescription medium = loadMedium("");
    expectRgb(medium.sigmaT, 1, 1, 1);
    expectRgb(medium.albedo, 0.75f, 0.75f, 0.75f);
    EXPECT_EQ(medium.phase, PHASE_ISOTROPIC);
    EXPECT_EQ(medium.id, "homogeneous@4");
    EXPECT_EQ(medium.where.line, 4);
    EXPECT_FALSE(medium.quasiSpecular.stated);
}

TEST(Medium, ScaleMultipliesTheExtinctionOnly) {
    const MediumDescription medium = loadMedium(R"(<rgb name="sigma_t" value="1,2,0"/><float name="scale" value="10"/>
        <rgb name="albedo" value="0,0.5,1"/>)");
    expectRgb(medium.sigmaT, 10, 20, 0);
    expectRgb(medium.albedo, 0, 0.5f, 1);
}

TEST(Medium, AUniformSpectrumIsItsNumber) {
    const MediumDescription medium =
        loadMedium(R"(<spectrum name="sigma_t" value="7.5"/><spectrum name="albedo" value="0.9"/>)");
    expectRgb(medium.sigmaT, 7.5f, 7.5f, 7.5f);
    expectRgb(medium.albedo, 0.9f, 0.9f, 0.9f);
}

// As Mitsuba 0.x had them.
TEST(Medium, ScatteringAndAbsorptionMakeExtinctionAndAlbedo) {
    const MediumDescription medium = loadMedium(
        R"(<rgb name="sigma_s" value="3,1,0"/><rgb name="sigma_a" value="1,1,0"/><float name="scale" value="2"/>)");
    expectRgb(medium.sigmaT, 8, 4, 0);
    expectRgb(medium.albedo, 0.75f, 0.5f, 0);
}

TEST(Medium, InAShapeWithoutABsdfNoLightEntersIt) {
    const std::string inside = "<medium type=\"homogeneous\" name=\"interior\"/></shape>";
    EXPECT_THAT(loadBody("<shape type=\"cube\" id=\"fog\">" + inside).warnings,
                ElementsAre(HasSubstr("no light enters the medium in shape 'fog'")));
    EXPECT_THAT(loadBody("<shape type=\"cube\"><bsdf type=\"null\"/>" + inside).warnings, testing::IsEmpty());
}

TEST(Medium, PhaseFunctions) {
    EXPECT_EQ(loadMedium(R"(<phase type="isotropic"/>)").phase, PHASE_ISOTROPIC);
    EXPECT_EQ(loadMedium(R"(<phase type="rayleigh"/>)").phase, PHASE_RAYLEIGH);
    const MediumDescription missing = loadMedium(R"(<phase type="hg"/>)");
    EXPECT_EQ(missing.phase, PHASE_HG);
    EXPECT_EQ(missing.g, 0.8);
    EXPECT_EQ(loadMedium(R"(<phase type="hg"><float name="g" value="-0.99"/></phase>)").g, -0.99);
}

TEST(Medium, ATabulatedPhaseFunctionIsNormalised) {
    const MediumDescription medium =
        loadMedium(R"(<phase type="tabphase"><string name="values" value="0, 0, 3"/></phase>)");
    ASSERT_EQ(medium.phase, PHASE_MIXED);
    ASSERT_EQ(medium.phaseParts.size(), 1u);
    // Integral over the cosine: 3 / 2; mean cosine of a density 2 c on [0, 1].
    EXPECT_NEAR(medium.phaseParts[0].values.at(2), 2 / (2 * 3.14159265358979), 1e-12);
    EXPECT_NEAR(medium.g, 2.0 / 3, 1e-12);
}

TEST(Medium, BlendsOfBlendsAreOneList) {
    const MediumDescription medium = loadMedium(R"(<phase type="blendphase"><float name="weight" value="0.25"/>
        <phase type="hg"><float name="g" value="0.5"/></phase>
        <phase type="blendphase"><float name="weight" value="0.4"/><phase type="rayleigh"/>
        <phase type="hg"><float name="g" value="-0.5"/></phase></phase></phase>)");
    ASSERT_EQ(medium.phase, PHASE_MIXED);
    ASSERT_EQ(medium.phaseParts.size(), 3u);
    const std::pair<unsigned, double> expected[] = {{PHASE_HG, 0.75}, {PHASE_RAYLEIGH, 0.15}, {PHASE_HG, 0.1}};
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(medium.phaseParts[k].phase, expected[k].first);
        EXPECT_NEAR(medium.phaseParts[k].weight, expected[k].second, 1e-12);
    }
    EXPECT_NEAR(medium.g, 0.75 * 0.5 - 0.1 * 0.5, 1e-12);
}

TEST(Medium, APhaseFunctionThatContainsItselfIsRefused) {
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml",
                                    sceneWith(R"(<phase type="blendphase" id="loop"><float name="weight" value="0.5"/>
        <phase type="hg"/><ref id="loop"/></phase>)"))),
                HasSubstr("scene.xml:4:1: phase 'loop' contains itself"));
}

TEST(Medium, KnownParametersWithoutEffectAreAccepted) {
    EXPECT_NO_THROW(loadMedium(
        R"(<boolean name="sample_emitters" value="true"/><boolean name="has_spectral_extinction" value="false"/>)"));
}

TEST(Medium, QuasiSpecularChoice) {
    using Kind = QuasiSpecularChoice::Kind;
    const auto choice = [](const std::string& value) {
        return loadMedium("<?quasilux quasi-specular=\"" + value + "\"?>").quasiSpecular;
    };
    EXPECT_EQ(choice("yes").kind, Kind::yes);
    EXPECT_EQ(choice("no").kind, Kind::no);
    EXPECT_EQ(choice("auto").kind, Kind::automatic);
    EXPECT_TRUE(choice("auto").stated);
    EXPECT_EQ(choice("level:0.25").kind, Kind::level);
    EXPECT_EQ(choice("level:0.25").level, 0.25);
}

TEST(Medium, SharedByReferenceItIsReadOnce) {
    const Scene scene = loadBody(R"(<medium type="homogeneous" id="fog"/>
        <shape type="cube"><ref name="interior" id="fog"/><bsdf type="null"/></shape>
        <shape type="sphere"><medium name="interior" type="homogeneous" id="milk"/><ref name="exterior" id="fog"/>
          <bsdf type="null"/></shape>
        <emitter type="point"><ref id="milk"/></emitter>)");
    ASSERT_EQ(scene.media.size(), 2u);
    EXPECT_EQ(scene.media[0].id, "fog");
    EXPECT_EQ(scene.media[1].id, "milk");
    EXPECT_EQ(scene.shapes[0].interior, 0u);
    EXPECT_FALSE(scene.shapes[0].exterior);
    EXPECT_EQ(scene.shapes[1].interior, 1u);
    EXPECT_EQ(scene.shapes[1].exterior, 0u);
    EXPECT_EQ(scene.pointEmitters.at(1).medium, 1u);
    EXPECT_FALSE(scene.pointEmitters.at(0).medium);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Medium, PhaseFunctionsCanBeReferredTo) {
    const Scene scene = loadBody(R"(<phase type="rayleigh" id="air"/>
        <shape type="cube"><bsdf type="null"/>
          <medium name="interior" type="homogeneous"><ref id="air"/></medium></shape>)");
    EXPECT_EQ(scene.media.at(0).phase, PHASE_RAYLEIGH);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Medium, OfASensor) {
    SceneFiles files;
    const auto loadWith = [&](const std::string& medium) {
        return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\">" + medium +
                                                      "</sensor><emitter type=\"point\"/></scene>"));
    };
    EXPECT_FALSE(loadWith("").sensor.medium);
    EXPECT_EQ(loadWith("<medium type=\"homogeneous\"/>").sensor.medium, 0u);
    EXPECT_EQ(loadWith("<medium name=\"medium\" type=\"homogeneous\"/>").sensor.medium, 0u);
}

TEST(Medium, AnEmittingShapeMayHaveOne) {
    const Scene scene = loadBody(R"(<shape type="sphere"><bsdf type="null"/><emitter type="area"/>
        <medium name="exterior" type="homogeneous"/></shape>)");
    EXPECT_TRUE(scene.shapes.at(0).emitter);
    EXPECT_EQ(scene.shapes.at(0).exterior, 0u);
}

TEST(Medium, UnusedOnesAreCheckedAndReported) {
    const Scene scene = loadBody("<medium type=\"homogeneous\" id=\"fog\"/>\n<phase type=\"hg\" id=\"haze\"/>");
    EXPECT_TRUE(scene.media.empty());
    EXPECT_THAT(scene.warnings,
                ElementsAre(HasSubstr("scene.xml:4:1: medium 'fog' is used by no shape, sensor or emitter"),
                            HasSubstr("scene.xml:5:1: phase 'haze' is used by no medium")));
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("bad.xml", sceneWith("<medium type=\"homogeneous\">\n<float name=\"albedo\" "
                                                         "value=\"2\"/></medium>"))),
                HasSubstr("bad.xml:5:1: parameter 'albedo'"));
}

TEST(Medium, SceneSettingTakesALevel) {
    EXPECT_EQ(loadBody("<?quasilux quasi-specular=\"level:0.2\"?>").settings.quasiSpecular, "level:0.2");
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith("<?quasilux quasi-specular=\"level:0\"?>"))),
                HasSubstr("scene.xml:4:1: quasi-specular: level 0 is out of range; expected sr^-1 above 0"));
}

struct BadMedium {
    const char* name;
    const char* content;               ///< of a medium; starts at line 5, column 1
    std::vector<const char*> expected; ///< parts of the message
};
void PrintTo(const BadMedium& bad, std::ostream* out) { *out << bad.content; }

class RefusedMedium : public testing::TestWithParam<BadMedium> {};

TEST_P(RefusedMedium, IsRefusedAtItsPlace) {
    SceneFiles files;
    const std::string message = errorOf(
        files.write("scene.xml", sceneWith("<shape type=\"cube\"><medium type=\"homogeneous\" name=\"interior\">\n" +
                                           std::string(GetParam().content) + "</medium></shape>")));
    for (const char* part : GetParam().expected) EXPECT_THAT(message, HasSubstr(part));
}

const BadMedium badMedia[] = {
    {"SigmaS",
     R"(<rgb name="sigma_s" value="1"/>)",
     {"scene.xml:5:1: parameter 'sigma_s' of medium 'homogeneous' is not supported", "give both sigma_s and sigma_a",
      "sigma_t = sigma_a + sigma_s and albedo = sigma_s / sigma_t"}},
    {"SigmaSWithAlbedo",
     "<rgb name=\"sigma_s\" value=\"1\"/><rgb name=\"sigma_a\" value=\"1\"/><rgb name=\"albedo\" value=\"1\"/>",
     {"scene.xml:5:1: medium 'homogeneous' has both sigma_s, sigma_a and albedo"}},
    {"SigmaA", R"(<rgb name="sigma_a" value="1"/>)", {"scene.xml:5:1: parameter 'sigma_a'", "sigma_t = sigma_a"}},
    {"NegativeExtinction",
     R"(<rgb name="sigma_t" value="1,-1,1"/>)",
     {"scene.xml:5:1: parameter 'sigma_t' of medium 'homogeneous' is (1, -1, 1); no channel may be negative"}},
    {"InfiniteExtinction", R"(<float name="sigma_t" value="inf"/>)", {"scene.xml:5:1: parameter 'sigma_t'", "finite"}},
    {"AlbedoAboveOne",
     R"(<rgb name="albedo" value="0.5,1.1,0.5"/>)",
     {"scene.xml:5:1: parameter 'albedo' of medium 'homogeneous'", "must lie within [0, 1]"}},
    {"NegativeScale", R"(<float name="scale" value="-1"/>)", {"scene.xml:5:1: parameter 'scale'", "at least 0"}},
    {"ScaleOverflows",
     "<float name=\"sigma_t\" value=\"1e30\"/>\n<float name=\"scale\" value=\"1e30\"/>",
     {"scene.xml:6:1: sigma_t times scale", "single precision"}},
    {"Volume",
     R"(<volume type="gridvolume" name="sigma_t"/>)",
     {"scene.xml:5:1: volume 'gridvolume' needs", "filename"}},
    {"VolumeAlbedoAboveOne",
     R"(<volume type="constvolume" name="albedo"><float name="value" value="2"/></volume>)",
     {"scene.xml:4:20: the albedo of medium 'homogeneous' has a channel above 1"}},
    {"BlendWithoutWeight",
     "<phase type=\"blendphase\"><phase type=\"hg\"/><phase type=\"hg\"/></phase>",
     {"scene.xml:5:1: phase 'blendphase' needs <float name=\"weight\""}},
    {"BlendOfOne",
     "<phase type=\"blendphase\"><float name=\"weight\" value=\"0.5\"/><phase type=\"hg\"/></phase>",
     {"scene.xml:5:1: phase 'blendphase' has 1 phase functions; expected 2"}},
    {"BlendByVolume",
     "<phase type=\"blendphase\">\n<volume name=\"weight\" type=\"constvolume\"/><phase type=\"hg\"/><phase "
     "type=\"hg\"/></phase>",
     {"scene.xml:6:1: parameter 'weight' of phase 'blendphase' is the same everywhere here", "<float>"}},
    {"TableOfOne",
     "<phase type=\"tabphase\">\n<string name=\"values\" value=\"1\"/></phase>",
     {"scene.xml:6:1: parameter 'values' of phase 'tabphase' has 1 entries; expected 2 to"}},
    {"TableNegative",
     "<phase type=\"tabphase\">\n<string name=\"values\" value=\"1,-1,2\"/></phase>",
     {"scene.xml:6:1: parameter 'values' of phase 'tabphase' has the entry -1"}},
    {"TableOfNothing",
     "<phase type=\"tabphase\">\n<string name=\"values\" value=\"0,0\"/></phase>",
     {"scene.xml:6:1: parameter 'values' of phase 'tabphase' adds up to 0"}},
    {"TableOfWords",
     "<phase type=\"tabphase\">\n<string name=\"values\" value=\"1,x\"/></phase>",
     {"scene.xml:6:1:", "'x' is not a number"}},
    {"Misspelt",
     R"(<float name="sigmat" value="1"/>)",
     {"scene.xml:5:1: unknown parameter 'sigmat' of medium 'homogeneous'", "Did you mean 'sigma_t'?"}},
    {"Texture", R"(<texture type="checkerboard" name="albedo"/>)", {"scene.xml:5:1:", "takes no texture as 'albedo'"}},
    {"TwoPhases", "<phase type=\"hg\"/>\n<phase type=\"hg\"/>", {"scene.xml:6:1:", "2 objects <phase>; expected one"}},
    {"UnknownPhase",
     R"(<phase type="rayleig"/>)",
     {"scene.xml:5:1: unknown phase plugin 'rayleig'", "Did you mean 'rayleigh'?"}},
    {"GOfOne",
     "<phase type=\"hg\">\n<float name=\"g\" value=\"1\"/></phase>",
     {"scene.xml:6:1: parameter 'g' of phase 'hg' is 1; it must lie between -1 and 1, both excluded"}},
    {"GOfMinusOne", "<phase type=\"hg\">\n<float name=\"g\" value=\"-1\"/></phase>", {"scene.xml:6:1: parameter 'g'"}},
    {"GThatSinglePrecisionMakesOne",
     "<phase type=\"hg\">\n<float name=\"g\" value=\"0.99999999999\"/></phase>",
     {"scene.xml:6:1: parameter 'g'"}},
    {"GOfIsotropic",
     "<phase type=\"isotropic\">\n<float name=\"g\" value=\"0.5\"/></phase>",
     {"scene.xml:6:1: unknown parameter 'g' of phase 'isotropic'"}},
    {"InstructionInAPhase",
     "<phase type=\"hg\">\n<?quasilux quasi-specular=\"yes\"?></phase>",
     {"scene.xml:6:1: <?quasilux?> has no meaning in <phase>"}},
    {"LobeList", R"(<?quasilux quasi-specular="specular"?>)", {"scene.xml:5:1:", "expected auto, yes, no, or a level"}},
    {"LevelZero", R"(<?quasilux quasi-specular="level:0"?>)", {"scene.xml:5:1: quasi-specular: level 0 is out of"}},
    {"NegativeLevel", R"(<?quasilux quasi-specular="level:-1"?>)", {"scene.xml:5:1: quasi-specular: level -1 is out"}},
    {"LevelOfInfinity", R"(<?quasilux quasi-specular="level:inf"?>)", {"scene.xml:5:1: quasi-specular: level: 'inf'"}},
    {"LevelThatIsNoNumber", R"(<?quasilux quasi-specular="level:x"?>)", {"scene.xml:5:1:", "'x' is not a number"}},
    {"UnknownKey",
     R"(<?quasilux quasispecular="yes"?>)",
     {"scene.xml:5:1: unknown key 'quasispecular' of <?quasilux?> in a medium", "Did you mean 'quasi-specular'?"}},
    {"TwoInstructions",
     "<?quasilux quasi-specular=\"yes\"?>\n<?quasilux quasi-specular=\"no\"?>",
     {"scene.xml:6:1: a second <?quasilux?> in one medium"}},
};
INSTANTIATE_TEST_SUITE_P(All, RefusedMedium, testing::ValuesIn(badMedia),
                         [](const auto& test) { return test.param.name; });

struct BadPlace {
    const char* name;
    const char* body;                  ///< starts at line 4, column 1
    std::vector<const char*> expected; ///< parts of the message
};
void PrintTo(const BadPlace& bad, std::ostream* out) { *out << bad.body; }

class RefusedPlace : public testing::TestWithParam<BadPlace> {};

TEST_P(RefusedPlace, IsRefusedAtItsPlace) {
    SceneFiles files;
    const std::string message = errorOf(files.write("scene.xml", sceneWith(GetParam().body)));
    for (const char* part : GetParam().expected) EXPECT_THAT(message, HasSubstr(part));
}

const BadPlace badPlaces[] = {
    {"WithoutAName",
     "<shape type=\"cube\">\n<medium type=\"homogeneous\"/></shape>",
     {"scene.xml:5:1: shape 'cube' takes no medium without a name", "Known: exterior, interior"}},
    {"MisspeltName",
     "<medium type=\"homogeneous\" id=\"fog\"/><shape type=\"cube\">\n<ref name=\"interor\" id=\"fog\"/></shape>",
     {"scene.xml:5:1: shape 'cube' takes no medium as 'interor'", "Did you mean 'interior'?"}},
    {"TwiceInside",
     "<shape type=\"cube\"><medium name=\"interior\" type=\"homogeneous\"/>\n<medium name=\"interior\" "
     "type=\"homogeneous\"/></shape>",
     {"scene.xml:5:1: parameter 'interior' is given twice", "scene.xml:4:"}},
    {"UnknownReference",
     "<medium type=\"homogeneous\" id=\"fog\"/><shape type=\"cube\">\n<ref name=\"interior\" id=\"fgo\"/></shape>",
     {"scene.xml:5:1: no object has the id 'fgo'", "Did you mean 'fog'?"}},
    {"InABsdf",
     "<bsdf type=\"diffuse\">\n<medium type=\"homogeneous\"/></bsdf>",
     {"scene.xml:5:1: bsdf 'diffuse' takes no <medium>"}},
    {"InAnAreaEmitter",
     "<shape type=\"cube\"><emitter type=\"area\">\n<medium type=\"homogeneous\"/></emitter></shape>",
     {"scene.xml:5:1: emitter 'area' takes no <medium>"}},
    {"LevelOfABsdf",
     "<bsdf type=\"diffuse\">\n<?quasilux quasi-specular=\"level:0.1\"?></bsdf>",
     {"scene.xml:5:1:", "a level splits phase functions"}},
};
INSTANTIATE_TEST_SUITE_P(All, RefusedPlace, testing::ValuesIn(badPlaces),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace quasilux
