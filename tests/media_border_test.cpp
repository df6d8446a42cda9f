// Emitters, grids and cameras that a border of a medium passes through: light begins in the medium of its own place.
// Closed forms. Values are means of 20 batches; seeds are fixed, and a right render fails with a probability of
// 1 % a value (Student t). Controls: all of them begin in vacuum; camera rays begin at the pinhole.
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::MediumRule;

constexpr double studentT = 2.86; // 19 degrees of freedom, 0.5 % on either side

Scene sceneOf(const std::string& body) {
    const test::SceneFiles files;
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\">" + body + "</scene>"));
}

std::string fogCube(const std::string& transform, double sigmaT, double albedo) {
    return "<shape type=\"cube\"><transform name=\"to_world\">" + transform +
           "</transform><bsdf type=\"null\"/><medium name=\"interior\" type=\"homogeneous\"><float name=\"sigma_t\" "
           "value=\"" +
           std::to_string(sigmaT) + "\"/><float name=\"albedo\" value=\"" + std::to_string(albedo) +
           "\"/></medium></shape>";
}

/// Means of groups of pixels.
std::vector<MeanAndError> means(const Scene& scene, MediumRule rule, const std::vector<int>& group, unsigned photons,
                                unsigned passes) {
    RenderSettings settings;
    settings.photonsPerPass = photons;
    settings.controlOptions = optionOf(rule);
    return renderGroups(scene, settings, group, 20, passes);
}

// Sunlight straight down on points at the height of the cube's middle, wherever the middle of the grid is.
TEST(MediaBorder, PointsOfAGridLieInTheirOwnMedium) {
    for (const double first : {-2.0, 0.0}) {
        const Scene scene =
            sceneOf("<?quasilux illuminance-grid origin=\"" + std::to_string(first - 1) +
                    ",-1,0\" edge-u=\"6,0,0\" edge-v=\"0,2,0\" nx=\"3\" ny=\"1\"?>" + fogCube("", 1, 0) +
                    R"(<emitter type="directional"><vector name="direction" value="0,0,-1"/></emitter>)");
        const auto right = means(scene, MediumRule::right, {0, 1, 2}, 1000, 1),
                   wrong = means(scene, MediumRule::vacuumAtBorders, {0, 1, 2}, 1000, 1);
        for (size_t k = 0; k < 3; ++k) {
            const double x = first + 2 * double(k), expected = std::abs(x) < 1 ? std::exp(-1) : 1;
            EXPECT_NEAR(right[k].mean, expected, 1e-5) << x;
            EXPECT_NEAR(wrong[k].mean, 1, 1e-5) << "negative control";
        }
    }
}

TEST(MediaBorder, RaysOfAnOrthographicCameraBeginInTheirOwnMedium) {
    const Scene scene = sceneOf(R"(<sensor type="orthographic"><float name="near_clip" value="0.001"/>
        <transform name="to_world"><scale value="2"/></transform><film type="hdrfilm"><integer name="width" value="4"/>
        <integer name="height" value="4"/><rfilter type="box"/></film></sensor>
        <shape type="rectangle"><transform name="to_world"><scale value="9"/><rotate x="1" angle="180"/><translate z="3"/>
        </transform><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)" +
                                fogCube("<scale x=\"1\" y=\"9\" z=\"1\"/>", 1, 0));
    std::vector<int> inFog(16);
    for (size_t k = 0; k < 16; ++k) inFog[k] = k % 4 == 1 || k % 4 == 2;
    const auto right = means(scene, MediumRule::right, inFog, 1000, 50),
               wrong = means(scene, MediumRule::vacuumAtBorders, inFog, 1000, 50);
    EXPECT_NEAR(right[0].mean, 1, 1e-5);
    EXPECT_NEAR(right[1].mean, std::exp(-0.999), studentT * right[1].standardError);
    EXPECT_LT(right[1].standardError, 0.02) << "too noisy to decide anything";
    EXPECT_NEAR(wrong[1].mean, 1, 1e-5) << "negative control";
}

/// Mean over a square film, `degrees` wide, of what comes through a slab of fog of this thickness, sigma_t 1.
double throughSlab(double thickness, double degrees) {
    const int cells = 64;
    const double halfWidth = std::tan(degrees / 2 * std::acos(-1) / 180);
    double sum = 0;
    for (int k = 0; k < cells * cells; ++k)
        sum += std::exp(-thickness * std::hypot(1, halfWidth * ((2 * (k % cells) + 1.0) / cells - 1),
                                                halfWidth * ((2 * (k / cells) + 1.0) / cells - 1)));
    return sum / (cells * cells);
}

// A cube of absorbing fog about a camera that stands before it or in it: what lies before the near plane is not seen,
// so light goes through the fog behind it alone. The near plane of the first lies in fog, that of the second in a
// border.
TEST(MediaBorder, RaysOfACameraBeginOnItsNearPlane) {
    for (const double near : {1.0, 0.5}) {
        const Scene scene =
            sceneOf(R"(<sensor type="perspective"><float name="fov" value="20"/><float name="near_clip"
            value=")" +
                    std::to_string(near) +
                    R"("/><transform name="to_world"><lookat origin="0,0,1.5" target="0,0,0" up="0,1,0"/>
            </transform><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
            <rfilter type="box"/></film></sensor><shape type="rectangle"><transform name="to_world"><scale value="9"/>
            <translate z="-2"/></transform><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)" +
                    fogCube("<scale x=\"9\" y=\"9\" z=\"1\"/>", 1, 0));
        const std::vector<int> all(16, 0);
        const auto right = means(scene, MediumRule::right, all, 1000, 100).front(),
                   wrong = means(scene, MediumRule::pinhole, all, 1000, 100).front();
        const double expected = throughSlab(near == 1 ? 1.5 : 2, 20);
        EXPECT_NEAR(right.mean, expected, studentT * right.standardError) << near;
        EXPECT_LT(right.standardError, 0.02 * expected) << "too noisy to decide anything";
        if (near == 1) {
            EXPECT_LT(wrong.mean, 0.5 * expected) << "negative control";
        }
    }
}

// A white cube of fog that sticks out of a furnace: radiance is 1 everywhere. All light within the fog is scattered
// once and more, most of it from photons.
TEST(MediaBorder, PhotonsOfAnEmitterBeginInTheMediumOfTheirPlace) {
    const Scene scene = sceneOf(R"(<sensor type="perspective"><float name="fov" value="30"/><transform name="to_world">
        <lookat origin="0,0,0" target="1,0,0" up="0,0,1"/></transform><film type="hdrfilm"><integer name="width" value="16"/>
        <integer name="height" value="16"/><rfilter type="box"/></film></sensor>
        <shape type="sphere"><float name="radius" value="5"/><boolean name="flip_normals" value="true"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)" +
                                fogCube("<scale value=\"2\"/><translate x=\"5\"/>", 3, 1));
    const std::vector<int> all(256, 0);
    const auto right = means(scene, MediumRule::right, all, 8000, 16).front(),
               wrong = means(scene, MediumRule::vacuumAtBorders, all, 8000, 16).front();
    EXPECT_NEAR(right.mean, 1, studentT * right.standardError + 0.01) << "1 % for the finite kernel";
    EXPECT_LT(right.standardError, 0.01) << "too noisy to decide anything";
    EXPECT_LT(wrong.mean, 0.9) << "negative control";
}

// A black meter at the bottom of a tilted cube of absorbing fog, on its border: light falls four units deep. Rounding
// puts half of its places beyond the border.
TEST(MediaBorder, AMeterOnABorderBeginsOnItsOwnSide) {
    const std::string turn = R"(<scale value="2"/><rotate x="1" angle="17.18873"/><rotate y="1" angle="11.45916"/>
        <translate x="0.1" y="0.2" z="0.3"/>)";
    const Scene scene = sceneOf(fogCube(turn, 0.5, 0) + R"(<shape type="rectangle"><transform name="to_world">
        <translate z="-1"/>)" + turn +
                                R"(</transform><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
        <sensor type="irradiancemeter"><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
        </film></sensor></shape><emitter type="directional"><vector name="direction" x="-0.189796" y="0.295520" z="-0.936293"/>
        </emitter>)");
    const auto found = means(scene, MediumRule::right, std::vector<int>(16, 0), 1000, 1).front();
    EXPECT_NEAR(found.mean, std::exp(-2), 1e-4);
}

// A white cube of fog in a furnace, crossed by null rectangles that say of both their sides that they are in it, as
// Mitsuba asks of shapes within media: radiance is 1 everywhere, and the planes are no borders of the density kernel.
TEST(MediaBorder, KernelsGoOnThroughSurfacesWithinFog) {
    std::string planes;
    for (const char* const turn : {"<translate z=\"0.1\"/>", "<rotate x=\"1\" angle=\"90\"/>"})
        planes +=
            std::string("<shape type=\"rectangle\"><transform name=\"to_world\">") + turn +
            R"(</transform><bsdf type="null"/><ref name="interior" id="fog"/><ref name="exterior" id="fog"/></shape>)";
    const Scene scene = sceneOf(R"(<sensor type="perspective"><float name="fov" value="30"/><transform name="to_world">
        <lookat origin="0,-4,2" target="0,0,0" up="0,0,1"/></transform><film type="hdrfilm"><integer name="width" value="16"/>
        <integer name="height" value="16"/><rfilter type="box"/></film></sensor><emitter type="constant"/>
        <medium type="homogeneous" id="fog"><float name="sigma_t" value="3"/><float name="albedo" value="1"/></medium>
        <shape type="cube"><bsdf type="null"/><ref name="interior" id="fog"/></shape>)" +
                                planes);
    const std::vector<int> all(256, 0);
    const auto right = means(scene, MediumRule::right, all, 8000, 4).front(),
               wrong = means(scene, MediumRule::cutWithinFog, all, 8000, 4).front();
    EXPECT_NEAR(right.mean, 1, studentT * right.standardError + 0.01) << "1 % for the finite kernel";
    EXPECT_LT(right.standardError, 0.01) << "too noisy to decide anything";
    EXPECT_GT(wrong.mean, 1.02 + studentT * wrong.standardError) << "negative control";
}

} // namespace
} // namespace quasilux
