// Emitter 'directionalarea': light along the normals of flat faces. Floors in its beam have radiances known in closed
// form, by emitter sampling and by photons. Renders are held to 4 standard errors of 10 batches (Student t: 0.3 % each)
// plus 0.5 %. Seeds are fixed.
#include "prepare/device_scene.h"
#include "support/scene_files.h"
#include "support/textured_emitters.h"
#include "support/wrong_learning.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double slope = 20 * pi / 180;

/// A floor of albedo 0.5, and the image of [0.3, 0.7] x [-0.7, -0.3] of it, from below the emitter.
Scene floorUnder(const std::string& shape) {
    test::SceneFiles files;
    // Rows from v = 0 on.
    writeFloats(files.path("quarters.exr"), 2, 2, {9, 9, 9, 0.5f, 0.5f, 0.5f, 0, 0, 0, 2, 2, 2});
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <scale value="0.2"/><rotate y="1" angle="180"/><translate x="0.5" y="-0.5" z="0.9"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="rectangle"><transform name="to_world">
        <scale value="3"/></transform><bsdf type="diffuse"/></shape>)" +
            shape + "</scene>"));
}

const std::string even = R"(<emitter type="directionalarea"><rgb name="radiance" value="2"/></emitter></shape>)";
// Of the quarters that of u, v > 1/2 has the value 2; turned downwards about x it lies at x > 0, y < 0.
const std::string quarters =
    R"(<emitter type="directionalarea"><texture type="bitmap" name="radiance"><string name="filename" value="quarters.exr"/>
    <string name="filter_type" value="nearest"/></texture></emitter></shape>)";

struct Case {
    const char* name;
    std::string shape;
    double cosine; ///< of the beam to the floor's normal
    double power;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case cases[] = {
    {"Rectangle",
     R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>)" +
         even,
     1, 8},
    {"TexturedRectangle",
     R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>)" +
         quarters,
     1, 4 * 11.5 / 4},
    {"SlopingDisk",
     R"(<shape type="disk"><transform name="to_world"><rotate x="1" angle="180"/><rotate y="1" angle="20"/><translate x="1.1" y="-0.5" z="2"/></transform>)" +
         even,
     std::cos(slope), 2 * pi},
    {"Cube", R"(<shape type="cube"><transform name="to_world"><translate z="2"/></transform>)" + even, 1, 48},
};

class DirectionalArea : public testing::TestWithParam<Case> {};

TEST_P(DirectionalArea, LightsTheFloorInItsBeamBySamplingAndByPhotonsWhateverWasLearned) {
    const Scene scene = floorUnder(GetParam().shape);
    const double truth = 0.5 / pi * 2 * GetParam().cosine;
    for (const DirectLight direct : {DirectLight::emitters, DirectLight::photons})
        for (const bool wrongly : {false, true}) {
            // Of a cube one face of twelve is sampled: the mean of fewer passes would not tell 5 % from nothing.
            const auto result = meanOfImage(scene, direct, wrongly, 20);
            const double allowed = 4 * result.standardError + 0.005 * truth;
            EXPECT_NEAR(result.mean, truth, allowed) << "photons " << (direct == DirectLight::photons) << wrongly;
            EXPECT_GT(std::abs(result.mean - (wrongly ? 2 : 1.05) * truth), allowed) << "negative control";
        }
}

TEST_P(DirectionalArea, HasItsIrradianceTimesItsAreaAsPower) {
    EXPECT_NEAR(lastEmitter(floorUnder(GetParam().shape)).power, GetParam().power, 0.005 * GetParam().power);
}

INSTANTIATE_TEST_SUITE_P(Shapes, DirectionalArea, testing::ValuesIn(cases),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(DirectionalAreas, AreBlackToACameraEvenInTheirBeam) {
    test::SceneFiles files;
    const auto seen = [&](const char* plugin) {
        const Scene scene = loadScene(files.write(
            "scene.xml",
            std::string(
                R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
            <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><rfilter type="box"/>
            <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
            <shape type="rectangle"><emitter type=")") +
                plugin + "\"/></shape></scene>"));
        return meanOfImage(scene, DirectLight::emitters, false).mean;
    };
    EXPECT_EQ(seen("directionalarea"), 0);
    EXPECT_NEAR(seen("area"), 1, 1e-5) << "control";
}

TEST(DirectionalAreas, AreFlat) {
    test::SceneFiles files;
    for (const char* shape : {"sphere", "cylinder"}) {
        const std::string body =
            std::string("<shape id=\"s\" type=\"") + shape + "\">\n<emitter type=\"directionalarea\"/></shape>";
        EXPECT_THAT(test::errorOf(files.write("scene.xml", test::sceneWith(body))),
                    HasSubstr("scene.xml:5:1: emitter 'directionalarea' emits along the normals of flat faces, but "
                              "shape 's' is curved"));
    }
}

} // namespace
} // namespace quasilux
