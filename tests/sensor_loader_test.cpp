// What a scene file says of its sensors, films, filters and integrator.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::loadBody;
using test::loadSensor;
using test::SceneFiles;

constexpr double degree = 3.14159265358979324 / 180;

TEST(PerspectiveSensor, FieldOfViewIsHorizontalForEveryAxis) {
    const std::string film =
        R"(<film type="hdrfilm"><integer name="width" value="400"/><integer name="height" value="200"/></film>)";
    const auto fov = [&](const std::string& axis) {
        return loadSensor(film + R"(<float name="fov" value="40"/><string name="fov_axis" value=")" + axis + "\"/>")
            .fovX;
    };
    const double half = std::tan(20 * degree);
    EXPECT_NEAR(fov("x"), 40 * degree, 1e-12);
    EXPECT_NEAR(fov("larger"), 40 * degree, 1e-12);
    EXPECT_NEAR(fov("y"), 2 * std::atan(2 * half), 1e-12);
    EXPECT_NEAR(fov("smaller"), 2 * std::atan(2 * half), 1e-12);
    EXPECT_NEAR(fov("diagonal"), 2 * std::atan(half * 400 / std::sqrt(400.0 * 400 + 200.0 * 200)), 1e-12);
}

TEST(PerspectiveSensor, DefaultsAreThoseOfMitsuba) {
    const Sensor sensor = loadSensor("");
    EXPECT_NEAR(sensor.fovX, 38.18484115600586 * degree, 1e-6); // Mitsuba 3.9: 50 mm lens, 768 × 576 pixels
    EXPECT_EQ(sensor.fovX, loadSensor(R"(<string name="focal_length" value="50mm"/>)").fovX);
    EXPECT_EQ(sensor.width, 768u);
    EXPECT_EQ(sensor.height, 576u);
    EXPECT_EQ(sensor.filter, FILTER_TABLE);
    EXPECT_NEAR(sensor.filterShape(0.5), std::exp(-0.5), 1e-12); // Gaussian, standard deviation 0.5
    EXPECT_EQ(sensor.filterRadius, 2.0);
    EXPECT_EQ(sensor.nearClip, 1e-2);
    EXPECT_EQ(sensor.farClip, 1e4);
}

TEST(Film, Filters) {
    const auto withFilter = [](const std::string& filter) {
        return loadSensor("<film type=\"hdrfilm\">" + filter + "</film>");
    };
    EXPECT_EQ(withFilter(R"(<rfilter type="box"/>)").filterRadius, 0.5);
    EXPECT_EQ(withFilter(R"(<rfilter type="tent"><float name="radius" value="1.5"/></rfilter>)").filterRadius, 1.5);
    const Sensor gaussian = withFilter(R"(<rfilter type="gaussian"><float name="stddev" value="0.7"/></rfilter>)");
    EXPECT_NEAR(gaussian.filterShape(0.7), std::exp(-0.5), 1e-12);
    EXPECT_NEAR(gaussian.filterRadius, 2.8, 1e-12);
}

TEST(Film, MoreFilters) {
    const auto withFilter = [](const std::string& filter) {
        return loadSensor("<film type=\"hdrfilm\">" + filter + "</film>");
    };
    const auto expectShape = [&](const std::string& filter, const std::vector<double>& expected) {
        const Sensor sensor = withFilter(filter); // values at 0, 0.25 … of Mitsuba 3.9's own filters
        for (size_t k = 0; k < expected.size(); ++k)
            EXPECT_NEAR(sensor.filterShape(0.25 * double(k)) / sensor.filterShape(0), expected[k] / expected[0], 2e-5)
                << filter << k;
    };
    expectShape(R"(<rfilter type="mitchell"/>)", {0.88889, 0.78212, 0.53472, 0.25608, 0.05556, -0.02344, -0.03472});
    expectShape(R"(<rfilter type="mitchell"><float name="C" value="0.2"/></rfilter>)",
                {0.88889, 0.77587, 0.51806, 0.23733, 0.05556, -0.00469, -0.01806});
    expectShape(R"(<rfilter type="catmullrom"/>)", {1, 0.86719, 0.5625, 0.22656, 0, -0.07031, -0.0625});
    expectShape(R"(<rfilter type="lanczos"/>)", {1, 0.89007, 0.60793, 0.27019, 0, -0.13287, -0.13509});
    const std::string two = R"(<rfilter type="lanczos"><integer name="lobes" value="2"/></rfilter>)";
    expectShape(two, {1, 0.87735, 0.57316, 0.23535, 0, -0.08472, -0.06368});
    EXPECT_EQ(withFilter(two).filterRadius, 2.0);
    EXPECT_EQ(withFilter(R"(<rfilter type="lanczos"/>)").filterRadius, 3.0);
}

TEST(Film, CropWindowAndFormats) {
    const Sensor sensor =
        loadSensor(R"(<float name="fov" value="60"/><film type="hdrfilm"><integer name="width" value="40"/>
        <integer name="height" value="20"/><integer name="crop_offset_x" value="8"/><integer name="crop_offset_y"
        value="2"/><integer name="crop_width" value="10"/><integer name="crop_height" value="12"/><boolean
        name="sample_border" value="false"/><string name="pixel_format" value="XYZA"/></film>)");
    EXPECT_EQ(sensor.filmWidth, 40u);
    EXPECT_EQ(sensor.filmHeight, 20u);
    EXPECT_EQ(sensor.width, 10u);
    EXPECT_EQ(sensor.height, 12u);
    EXPECT_EQ(sensor.cropX, 8u);
    EXPECT_EQ(sensor.cropY, 2u);
    EXPECT_NEAR(sensor.fovX, 60 * degree, 1e-12); // of the whole film
    EXPECT_TRUE(sensor.filterEnds);
    EXPECT_TRUE(sensor.pixelFormat.xyz && sensor.pixelFormat.alpha && !sensor.pixelFormat.luminance);
    EXPECT_FALSE(loadSensor("").filterEnds);
}

TEST(Sensors, TheFirstOfSeveralIsTakenWithAWarning) {
    const Scene scene = loadBody("<sensor type=\"perspective\"><float name=\"fov\" value=\"10\"/></sensor>");
    EXPECT_NEAR(scene.sensor.fovX, 38.18484 * degree, 1e-6);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], testing::HasSubstr("scene.xml:4:1: a further <sensor>"));
}

TEST(Sensors, ManyFurtherOnesAreOneWarning) {
    std::string more;
    for (int k = 0; k < 5; ++k) more += "<sensor type=\"perspective\"/>\n";
    EXPECT_THAT(loadBody(more).warnings,
                testing::ElementsAre(testing::AllOf(testing::HasSubstr("scene.xml:4:1: 5 further sensors"),
                                                    testing::HasSubstr("--sensor 1 to 5 renders another"))));
}

TEST(Sensors, OneOfSeveralIsChosenByNumberOrId) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", R"(<scene version="3.0.0">
<sensor type="perspective" id="left"><float name="fov" value="10"/></sensor>
<shape type="sphere" id="ball"><sensor type="irradiancemeter" id="meter"/></shape>
<sensor type="perspective"><float name="fov" value="20"/></sensor>
<sensor type="perspective" id="0"><float name="fov" value="30"/></sensor>
<emitter type="point"/></scene>)");
    const auto fov = [&](const std::string& sensor) {
        const Scene scene = loadScene(path, {}, {sensor});
        EXPECT_EQ(scene.sensorCount, 4u);
        EXPECT_EQ(scene.warnings.size(), sensor.empty() ? 1u : 0u);
        return scene.sensor.fovX / degree;
    };
    EXPECT_NEAR(fov(""), 10, 1e-9);
    EXPECT_NEAR(fov("left"), 10, 1e-9);
    EXPECT_NEAR(fov("2"), 20, 1e-9); // in the order of the file, those in shapes too, as in Mitsuba 3.9
    EXPECT_NEAR(fov("0"), 30, 1e-9) << "an id that is a number";
    EXPECT_EQ(loadScene(path, {}, {"1"}).sensor.meter, MeterKind::area);
    EXPECT_EQ(loadScene(path, {}, {"meter"}).sensor.meter, MeterKind::area);
    for (const char* wrong : {"4", "lef", "-1", "99999999999999999999", "all"}) try {
            loadScene(path, {}, {wrong});
            ADD_FAILURE() << wrong;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(std::string("has no sensor '") + wrong + "'"));
            EXPECT_THAT(error.what(), testing::HasSubstr("numbers 0 to 3"));
        }
}

TEST(Sensors, OfABatchHaveEqualPartsOfItsFilm) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", R"(<scene version="3.0.0">
<sensor type="batch"><sensor type="perspective" id="left"><float name="fov" value="10"/><film type="hdrfilm"><integer name="width" value="7"/></film></sensor>
<sensor type="orthographic" id="right"/>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="tent"/></film><sampler type="independent"/></sensor>
<sensor type="perspective"><float name="fov" value="20"/></sensor><emitter type="point"/></scene>)");
    for (const char* wanted : {"", "left", "right", "1"}) {
        const Scene scene = loadScene(path, {}, {wanted});
        EXPECT_EQ(scene.sensorCount, 3u);
        EXPECT_EQ(scene.sensor.width, 32u);
        EXPECT_EQ(scene.sensor.filmWidth, 32u);
        EXPECT_EQ(scene.sensor.height, 48u);
        EXPECT_EQ(scene.sensor.filter, unsigned(FILTER_TABLE));
        EXPECT_EQ(scene.sensor.orthographic, *wanted == 'r' || *wanted == '1');
    }
    EXPECT_EQ(loadScene(path, {}, {"2"}).sensor.width, 768u);
}

TEST(Integrator, DepthLimit) {
    const auto depth = [](const std::string& integrator) { return loadBody(integrator).maxDepth; };
    const auto path = [&](const std::string& value) {
        return depth(R"(<integrator type="path"><integer name="max_depth" value=")" + value + R"("/></integrator>)");
    };
    EXPECT_EQ(depth(""), -1);
    for (const int value : {-1, 0, 1, 2, 7}) EXPECT_EQ(path(std::to_string(value)), value);
    EXPECT_EQ(depth(R"(<integrator type="volpath"/>)"), -1);
    EXPECT_EQ(depth(R"(<integrator type="direct"><integer name="emitter_samples" value="4"/></integrator>)"), 2);
    // Mitsuba's default of those for derivatives.
    for (const std::string type : {"prb", "prb_basic", "prb_projective", "prb_reparam", "prbvolpath"}) {
        EXPECT_EQ(depth("<integrator type=\"" + type + "\"/>"), 6) << type;
        EXPECT_EQ(depth("<integrator type=\"" + type + R"("><integer name="max_depth" value="-1"/></integrator>)"), -1);
    }
    EXPECT_EQ(depth(R"(<integrator type="direct_projective"><integer name="max_depth" value="7"/></integrator>)"), 2);
    const std::string former = R"(<integer name="reparam_rays" value="8"/></integrator>)";
    EXPECT_EQ(depth(R"(<integrator type="direct_reparam">)" + former), 2);
    EXPECT_EQ(depth(R"(<integrator type="prb_reparam">)" + former), 6);
    const std::string aov =
        R"(<integrator type="aov"><string name="aovs" value="dd.y:depth"/><integrator type="direct"/></integrator>)";
    EXPECT_EQ(depth(aov), 2);
    const Scene scene = loadBody(aov);
    ASSERT_EQ(scene.aovs.size(), 1u);
    EXPECT_EQ(scene.aovs[0].name, "dd.y");
    EXPECT_EQ(scene.aovs[0].quantity, AovQuantity::depth);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_THAT(loadBody(R"(<integrator type="moment"><integrator type="path"/></integrator>)").warnings[0],
                testing::HasSubstr("stderr.R"));
}

// Mitsuba refuses them too, as channels of one name, where it writes the image.
TEST(Integrator, LayersHaveChannelsOfTheirOwn) {
    const auto aov = [](const std::string& layers) {
        return "<integrator type=\"aov\"><string name=\"aovs\" value=\"" + layers + "\"/></integrator>";
    };
    EXPECT_EQ(loadBody(aov("a:position,b:position,a:albedo,a:depth,stderr:depth")).aovs.size(), 5u);
    SceneFiles files;
    const auto error = [&](const std::string& layers) {
        return test::errorOf(files.write("scene.xml", test::sceneWith(aov(layers))));
    };
    EXPECT_THAT(error("a:position,a:sh_normal"), testing::HasSubstr("two layers have channels 'a.X'"));
    for (const char* taken : {"stderr", "direct", "bias"})
        EXPECT_THAT(error(std::string(taken) + ":albedo"),
                    testing::HasSubstr(std::string("the image has a layer '") + taken + "' itself"));
}

TEST(Integrator, LayersOfAMeterAreMissed) {
    const auto warnings = [](const std::string& sensor) {
        SceneFiles files;
        return loadScene(files.write("scene.xml", R"(<scene version="3.0.0"><integrator type="aov"><string name="aovs"
            value="d:depth"/><integrator type="path"/></integrator><emitter type="constant"/>
            <sensor type=")" + sensor + R"("><film type="hdrfilm"><integer name="width" value="1"/>
            <integer name="height" value="1"/></film></sensor></scene>)"))
            .warnings;
    };
    EXPECT_THAT(warnings("radiancemeter"), testing::ElementsAre(testing::HasSubstr(
                                               "the radiancemeter has neither layers of integrator 'aov' nor alpha")));
    EXPECT_TRUE(warnings("perspective").empty());
}

// Mitsuba 3.9.1: a point lights nothing without samples of emitters, a mirror under a white sky is black without those
// of bsdfs, and it refuses a scene with neither.
TEST(Integrator, SamplesThatMitsubaLacksAreWarnedOf) {
    const auto integrator = [](const std::string& name, int count) {
        return "<integrator type=\"direct\">\n<integer name=\"" + name + "\" value=\"" + std::to_string(count) +
               "\"/></integrator>";
    };
    const auto warnings = [&](const std::string& name, int count) {
        return loadBody(integrator(name, count)).warnings;
    };
    for (const std::string name : {"emitter_samples", "bsdf_samples"}) {
        EXPECT_THAT(warnings(name, 0), testing::ElementsAre(testing::AllOf(
                                           testing::HasSubstr("scene.xml:5:1: integrator 'direct' without " + name),
                                           testing::HasSubstr("Mitsuba's image lacks"))));
        EXPECT_TRUE(warnings(name, 1).empty()) << name;
    }
    EXPECT_TRUE(warnings("shading_samples", 4).empty());
    SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write("scene.xml", test::sceneWith(integrator("shading_samples", 0)))),
                testing::HasSubstr("scene.xml:4:1: integrator 'direct' has neither emitter_samples nor bsdf_samples"));
    EXPECT_THAT(test::errorOf(files.write("scene.xml", test::sceneWith(integrator("bsdf_samples", -1)))),
                testing::HasSubstr("'bsdf_samples' is -1"));
}

// As in Mitsuba 3.9.1, where that of the outer one changes no pixel.
TEST(Integrator, EmittersAreHiddenByTheNestedOneAlone) {
    const auto hide = [](const char* value) {
        return std::string(R"(<boolean name="hide_emitters" value=")") + value + "\"/>";
    };
    for (const std::string outer : {"aov", "moment"}) {
        const auto hides = [&](const std::string& ofOuter, const std::string& ofNested) {
            return loadBody("<integrator type=\"" + outer + "\">" + ofOuter + R"(<integrator type="path">)" + ofNested +
                            "</integrator></integrator>")
                .hideEmitters;
        };
        EXPECT_FALSE(hides(hide("true"), "")) << outer;
        EXPECT_FALSE(hides(hide("true"), hide("false"))) << outer;
        EXPECT_TRUE(hides(hide("false"), hide("true"))) << outer;
        EXPECT_TRUE(hides("", hide("true"))) << outer;
    }
}

TEST(Integrator, FormerOnesForAllLightAreThePath) {
    const std::string limit = R"(<integer name="max_depth" value="4"/>)";
    for (const std::string type : {"bdpt", "vpl", "volpath_simple", "volpathsimple"})
        EXPECT_EQ(loadBody("<integrator type=\"" + type + "\">" + limit +
                           R"(<integer name="of_its_own" value="2"/></integrator>)")
                      .maxDepth,
                  4)
            << type;
    for (const std::string type : {"irrcache", "adaptive"})
        EXPECT_EQ(loadBody("<integrator type=\"" + type +
                           R"("><float name="of_its_own" value="1"/><integrator type="path">)" + limit +
                           "</integrator></integrator>")
                      .maxDepth,
                  4)
            << type;
}

TEST(Integrator, WhatHasNoEffectIsListed) {
    const Scene scene = loadBody(R"(<integrator type="path"><integer name="rr_depth" value="3"/></integrator>)");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_THAT(scene.withoutEffect, testing::ElementsAre("rr_depth"));
}

} // namespace
} // namespace quasilux
