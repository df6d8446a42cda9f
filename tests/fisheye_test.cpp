// The fisheye: its rays by the projections' definitions, illuminances by its image in closed form, and that `quasilux
// dgp` knows its images.
#include "photometry/daylight_glare.h"
#include "prepare/device_scene.h"
#include "render/renderer.h"
#include "support/program_runner.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;

std::string fisheye(const std::string& parameters, unsigned width, unsigned height) {
    return fmt::format("<sensor type=\"quasilux_fisheye\">{}<film type=\"hdrfilm\"><rfilter type=\"box\"/>"
                       "<integer name=\"width\" value=\"{}\"/><integer name=\"height\" value=\"{}\"/></film></sensor>",
                       parameters, width, height);
}

std::string projectionXml(const std::string& name, double degrees = 180) {
    return fmt::format("<string name=\"projection\" value=\"{}\"/><float name=\"fov\" value=\"{}\"/>", name, degrees);
}

Scene sceneOf(const std::string& body) {
    test::SceneFiles files;
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\">" + body + "</scene>"));
}

constexpr const char* sky = R"(<emitter type="constant"><rgb name="radiance" value="2"/></emitter>)";

/// Distance from the middle, in half widths, by definition.
double radiusOf(const std::string& projection, double half, double theta) {
    if (projection == "equidistant") return theta / half;
    if (projection == "equisolid") return std::sin(theta / 2) / std::sin(half / 2);
    return std::sin(theta) / std::sin(half);
}

struct Expected {
    std::string projection;
    double degrees;
};
constexpr const char* placed =
    R"(<transform name="to_world"><lookat origin="1,2,3" target="1,2,-1" up="0,1,0"/></transform>
       <float name="near_clip" value="0.5"/><float name="far_clip" value="9"/>)";

// Looking along -z with +y up, +x is on the right.
TEST(Fisheye, RaysAreThoseOfTheProjection) {
    constexpr unsigned width = 40, height = 20;
    Program program = testProgram("camera.cl", "-DBVH_STACK_SIZE=32 -DHAS_FISHEYE_CAMERA");
    Buffer<float> out(testDevice(), size_t{8} * width * height, "rays");
    for (const auto& [projection, degrees] :
         {Expected{"equidistant", 180}, Expected{"equidistant", 300}, Expected{"equisolid", 180},
          Expected{"equisolid", 360}, Expected{"orthographic", 180}, Expected{"orthographic", 90}}) {
        const Scene scene = sceneOf(fisheye(placed + projectionXml(projection, degrees), width, height) + sky);
        shared::Camera camera = flattenCamera(scene.sensor);
        camera.filterRadius = 0; // through the centres of the pixels
        program.kernel("cameraRays").launch(size_t{width} * height, camera, 0u, out);
        const auto v = out.read();
        for (unsigned pixel = 0; pixel < width * height; ++pixel) {
            const float* ray = &v[size_t{8} * pixel];
            const double x = (pixel % width + 0.5) / 20 - 1, y = 0.5 - (pixel / width + 0.5) / 20, r = std::hypot(x, y);
            test::expectNear({ray[0], ray[1], ray[2]}, {1, 2, 3});
            if (r > 1) {
                EXPECT_LT(ray[7], 0) << "beyond the circle";
                continue;
            }
            EXPECT_EQ(ray[6], 0.5F);
            EXPECT_EQ(ray[7], 9.F);
            const double theta = std::acos(std::clamp(double(-ray[5]), -1.0, 1.0));
            EXPECT_NEAR(radiusOf(projection, degrees * pi / 360, theta), r, 2e-3) << projection << ' ' << degrees;
            EXPECT_NEAR(ray[3] * y, ray[4] * x, 1e-5) << "the same side of the middle";
            if (theta > 0.1 && theta < 3) {
                EXPECT_GT(ray[3] * x + ray[4] * y, 0);
            }
        }
    }
}

/// As `quasilux dgp` finds it, in the units of the image's radiance.
double illuminanceOf(const Scene& scene, Projection projection, unsigned passes, MapOrder map = MapOrder::photons) {
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    settings.map = map;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    const FilmImage image = renderer.develop();
    LuminanceImage luminance;
    luminance.width = image.width;
    luminance.height = image.height;
    for (size_t k = 0; k < image.radiance.size(); k += 3) luminance.values.push_back(image.radiance[k]);
    return daylightGlare(luminance, {projection, pi}, 1e9, std::nullopt).illuminance;
}

const std::pair<std::string, Projection> projections[] = {{"equidistant", Projection::equidistant},
                                                          {"equisolid", Projection::equisolid},
                                                          {"orthographic", Projection::orthographic}};

// A sky of radiance L all around: pi L at the eye.
TEST(Fisheye, UniformSkyLightsTheEyeByPiL) {
    for (const auto& [name, projection] : projections) {
        const Scene scene = sceneOf(fisheye(projectionXml(name), 128, 128) + sky);
        // Pixels on the rim count as their centres: 1 % of an orthographic image, less of the others.
        EXPECT_NEAR(illuminanceOf(scene, projection, 4), 2 * pi, 0.01 * 2 * pi) << name;
        EXPECT_NEAR(illuminanceOf(scene, projection, 4, MapOrder::camera), 2 * pi, 0.01 * 2 * pi) << name;
    }
}

// A disc of radius 1 at distance 1, radiance 2, that faces the eye: E = pi L sin² 45° times the cosine from the line of
// sight.
TEST(Fisheye, DiscLightsTheEyeAsInClosedForm) {
    const auto disc = [](double degrees) {
        return fmt::format("<shape type=\"disk\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/>"
                           "<translate z=\"1\"/><rotate y=\"1\" angle=\"{}\"/></transform>"
                           "<emitter type=\"area\"><rgb name=\"radiance\" value=\"2\"/></emitter></shape>",
                           degrees);
    };
    for (const auto& [name, projection] : projections)
        for (const double degrees : {0.0, 40.0}) {
            const Scene scene = sceneOf(fisheye(projectionXml(name), 128, 128) + disc(degrees));
            const double expected = pi * std::cos(degrees * pi / 180);
            EXPECT_NEAR(illuminanceOf(scene, projection, 16), expected, 0.005 * expected) << name << ' ' << degrees;
            // Wrong rule: as though it were another fisheye.
            const Projection other =
                projection == Projection::equisolid ? Projection::orthographic : Projection::equisolid;
            EXPECT_GT(std::abs(illuminanceOf(scene, other, 1) - expected), 0.01 * expected) << name;
        }
}

TEST(Fisheye, WrongParametersAreRefused) {
    const test::SceneFiles files;
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {fisheye(projectionXml("stereographic"), 8, 8), {"unknown value 'stereographic'", "equidistant"}},
        {fisheye(projectionXml("orthographic", 181), 8, 8), {"'fov' is 181", "up to 180"}},
        {fisheye(projectionXml("equisolid", 0), 8, 8), {"'fov' is 0", "up to 360"}},
        {fisheye("<float name=\"fov_axis\" value=\"1\"/>", 8, 8), {"fov_axis"}},
        {fisheye("<transform name=\"to_world\"><scale value=\"2\"/></transform>", 8, 8), {"scales or shears"}},
    };
    test::expectErrors(files, cases);
}

class FisheyeImage : public CommandLineTest {
protected:
    void write(const std::string& ofFilm) const {
        std::string sensor = fisheye(projectionXml("orthographic"), 96, 96);
        sensor.insert(sensor.find("<rfilter"), ofFilm);
        std::ofstream(folder / "sky.xml") << "<scene version=\"3.0.0\"><?quasilux units=\"photometric\"?>" << sensor
                                          << R"(<emitter type="constant"><rgb name="radiance" value="200"/></emitter>)"
                                          << "</scene>";
    }
    std::string projectionIn(const std::string& image) const {
        const auto file = OIIO::ImageInput::open((folder / image).string());
        return file ? std::string(file->spec().get_string_attribute("quasilux:projection")) : "no image";
    }
};

TEST_F(FisheyeImage, SaysToDgpHowItShowsDirections) {
    write("");
    ASSERT_EQ(run({"render", "sky.xml", "--fixed", "--passes", "2", "--quiet"}).exitCode, 0);
    const auto illuminance = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"dgp", "sky.exr", "--json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return nlohmann::json::parse(run(arguments).output)["illuminance"].get<double>();
    };
    EXPECT_NEAR(illuminance({}), 200 * pi, 0.01 * 200 * pi);
    EXPECT_EQ(illuminance({}), illuminance({"--projection", "orthographic"}));
    EXPECT_NE(illuminance({}), illuminance({"--projection", "equidistant"})) << "what is given holds";
    EXPECT_EQ(projectionIn("sky.exr"), "orthographic");
    // Merged passes are of the same view.
    for (const char* passes : {"0:1", "1:2"}) {
        const std::string name = passes + std::string(1, '.') + "ckpt";
        ASSERT_EQ(run({"render", "sky.xml", "--fixed", "--passes", passes, "--checkpoint", name, "--quiet"}).exitCode,
                  0);
    }
    ASSERT_EQ(run({"merge", "0:1.ckpt", "1:2.ckpt", "-o", "sky.exr"}).exitCode, 0);
    EXPECT_EQ(projectionIn("sky.exr"), "orthographic");
    EXPECT_NEAR(illuminance({}), 200 * pi, 0.01 * 200 * pi);
    // Of a part of the film nothing is said.
    write(R"(<integer name="crop_width" value="48"/>)");
    ASSERT_EQ(run({"render", "sky.xml", "--fixed", "--passes", "1", "--quiet"}).exitCode, 0);
    EXPECT_EQ(projectionIn("sky.exr"), "");
    expectRefused({"dgp", "sky.exr"}, "sky.exr: its header does not say how it shows directions");
    EXPECT_EQ(run({"dgp", "sky.exr", "--projection", "orthographic"}).exitCode, 0) << "what is given holds";
}

// Only a camera that looks through the middle of its film shows directions as DGP takes them.
TEST_F(FisheyeImage, OfAnotherCameraIsNoFisheye) {
    const auto render = [&](const std::string& sensor, const std::string& ofFilm) {
        std::ofstream(folder / "sky.xml")
            << "<scene version=\"3.0.0\"><sensor " << sensor << "<film type=\"hdrfilm\">"
            << "<integer name=\"width\" value=\"32\"/><integer name=\"height\" value=\"32\"/>" << ofFilm
            << R"(</film></sensor><emitter type="constant"><rgb name="radiance" value="1"/></emitter></scene>)";
        EXPECT_EQ(run({"render", "sky.xml", "--fixed", "--passes", "1", "--quiet"}).exitCode, 0);
        return projectionIn("sky.exr");
    };
    const std::string perspective = R"(type="perspective"><float name="fov" value="40"/>)";
    EXPECT_EQ(render(perspective, ""), "perspective");
    expectRefused({"dgp", "sky.exr"}, "shows 14 % of what lights the eye");
    expectRefused({"dgp", "sky.exr", "--projection", "equisolid", "--fov", "90"}, "shows 50 % of what lights the eye");
    EXPECT_EQ(run({"dgp", "sky.exr", "--illuminance", "2000"}).exitCode, 0) << "the angle is that of the header";
    for (const auto& [sensor, ofFilm] : std::vector<std::pair<std::string, std::string>>{
             {perspective, R"(<integer name="crop_width" value="16"/>)"},
             {perspective + R"(<float name="principal_point_offset_x" value="0.1"/>)", ""},
             {R"(type="orthographic">)", ""}}) {
        EXPECT_EQ(render(sensor, ofFilm), "") << sensor;
        expectRefused({"dgp", "sky.exr", "--illuminance", "2000"}, "give --projection NAME and --fov DEGREES");
    }
}

} // namespace
} // namespace quasilux
