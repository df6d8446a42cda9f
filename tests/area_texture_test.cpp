// Emitting shapes whose radiance is a texture: floors that they light against integrals over the shape, by emitter
// sampling, hits and photons; what the camera sees of them; their power. Renders are held to 4 standard errors of 10
// batches (Student t: 0.3 % each) plus
// 0.5 %. Seeds are fixed.
#include "prepare/device_scene.h"
#include "support/scene_files.h"
#include "support/textured_emitters.h"
#include "support/wrong_learning.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec2;
using glm::dvec3;
using std::numbers::pi;
using testing::HasSubstr;

/// Of the texture's four pixels, rows from v = 0 on: values above 1 and black ones.
constexpr double values[2][2] = {{4, 0.5}, {1, 0}};
constexpr double evenValue = (4 + 0.5 + 1) / 4;
double valueAt(const dvec2& uv) { return values[uv.y < 0.5 ? 0 : 1][uv.x < 0.5 ? 0 : 1]; }

void writeQuarters(const test::SceneFiles& files) {
    std::vector<float> pixels;
    for (const auto& row : values)
        for (const double value : row) pixels.insert(pixels.end(), 3, static_cast<float>(value));
    writeFloats(files.path("quarters.exr"), 2, 2, pixels);
}

std::string emitting(const std::string& shape, const std::string& parameters) {
    return "<shape type=\"" + shape + "\">" + parameters + R"(<emitter type="area"><texture type="bitmap"
        name="radiance"><string name="filename" value="quarters.exr"/><string name="filter_type" value="nearest"/></texture></emitter></shape>)";
}

struct Point {
    dvec3 position, normal;
    dvec2 uv;
};
struct Case {
    const char *name, *shape, *parameters;
    double area;
    std::function<Point(double x, double y)> at; ///< of even numbers in the unit square, even by area
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

dvec3 onSphere(const dvec2& uv) {
    const double azimuth = 2 * pi * uv.x, angle = pi * uv.y;
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}
dvec2 uvOnSphere(double x, double y) { return {x, std::acos(1 - 2 * y) / pi}; }

const Case cases[] = {
    {"Rectangle", "rectangle",
     R"(<transform name="to_world"><scale x="0.7" y="0.5"/><rotate x="1" angle="180"/><translate z="2"/></transform>)",
     1.4,
     [](double x, double y) {
         return Point{{0.7 * (2 * x - 1), -0.5 * (2 * y - 1), 2}, {0, 0, -1}, {x, y}};
     }},
    {"FlippedRectangle", "rectangle",
     R"(<boolean name="flip_normals" value="true"/><transform name="to_world"><scale x="0.7" y="0.5"/><translate z="2"/></transform>)",
     1.4,
     [](double x, double y) {
         return Point{{0.7 * (2 * x - 1), 0.5 * (2 * y - 1), 2}, {0, 0, -1}, {x, y}};
     }},
    {"Disk", "disk",
     R"(<transform name="to_world"><scale value="0.6"/><rotate x="1" angle="180"/><translate z="2"/></transform>)",
     0.36 * pi,
     [](double x, double y) {
         const double radius = std::sqrt(x), angle = 2 * pi * y;
         return Point{{0.6 * radius * std::cos(angle), -0.6 * radius * std::sin(angle), 2}, {0, 0, -1}, {radius, y}};
     }},
    {"Sphere", "sphere",
     R"(<float name="radius" value="0.5"/><transform name="to_world"><rotate x="1" angle="90"/><translate z="2"/></transform>)",
     pi,
     [](double x, double y) {
         const dvec2 uv = uvOnSphere(x, y);
         const dvec3 local = onSphere(uv), outward(local.x, -local.z, local.y);
         return Point{dvec3(0, 0, 2) + 0.5 * outward, outward, uv};
     }},
    {"SphereFromWithin", "sphere",
     R"(<float name="radius" value="3"/><boolean name="flip_normals" value="true"/><transform name="to_world"><rotate x="1" angle="90"/></transform>)",
     36 * pi,
     [](double x, double y) {
         const dvec2 uv = uvOnSphere(x, y);
         const dvec3 local = onSphere(uv), outward(local.x, -local.z, local.y);
         return Point{3.0 * outward, -outward, uv};
     }},
};

/// Half the width of the image, and its middle.
constexpr double half = 0.3;
constexpr dvec2 middle(0.4, 0.2);

/// A floor of albedo 0.5 below the emitter; the camera looks at it from below that.
std::string floorText(const std::string& emitter) {
    return R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <scale value="0.3"/><rotate y="1" angle="180"/><translate x="0.4" y="0.2" z="1.3"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="rectangle"><bsdf type="diffuse"/></shape>)" +
           emitter + "</scene>";
}

Scene floorUnder(const Case& c) {
    test::SceneFiles files;
    writeQuarters(files);
    return loadScene(files.write("scene.xml", floorText(emitting(c.shape, c.parameters))));
}

/// Mean radiance of the image, by sums over the emitter.
double floorRadiance(const Case& c, const std::function<double(const dvec2& uv)>& radiance) {
    constexpr int n = 10, m = 200;
    double sum = 0;
    for (int k = 0; k < n * n; ++k) {
        const dvec3 place(middle + half * (2.0 * (dvec2(k % n, k / n) + 0.5) / double(n) - 1.0), 0);
        for (int i = 0; i < m * m; ++i) {
            const Point p = c.at((i % m + 0.5) / m, (i / m + 0.5) / m);
            const dvec3 offset = p.position - place;
            const double cosines = std::max(offset.z, 0.0) * std::max(-glm::dot(offset, p.normal), 0.0);
            sum += radiance(p.uv) * cosines / std::pow(glm::dot(offset, offset), 2);
        }
    }
    return 0.5 / pi * c.area * sum / (double(n) * n * m * m);
}

class TexturedShape : public testing::TestWithParam<Case> {};

TEST_P(TexturedShape, LightsAFloorAlikeBySamplingAndByPhotonsWhateverWasLearned) {
    const double truth = floorRadiance(GetParam(), valueAt);
    const double even = floorRadiance(GetParam(), [](const dvec2&) { return evenValue; });
    ASSERT_GT(std::abs(even - truth), 0.05 * truth) << "it does not matter where the texture is bright";
    const Scene scene = floorUnder(GetParam());
    for (const DirectLight direct : {DirectLight::emitters, DirectLight::photons})
        for (const bool wrongly : {false, true}) {
            const auto result = meanOfImage(scene, direct, wrongly);
            const double allowed = 4 * result.standardError + 0.005 * truth;
            EXPECT_NEAR(result.mean, truth, allowed) << "photons " << (direct == DirectLight::photons) << wrongly;
            EXPECT_GT(std::abs(result.mean - (wrongly ? 2 * truth : even)), allowed) << "negative control";
        }
}

TEST_P(TexturedShape, HasThePowerOfItsTexture) {
    const Case& c = GetParam();
    constexpr int m = 400;
    double sum = 0;
    for (int i = 0; i < m * m; ++i) sum += valueAt(c.at((i % m + 0.5) / m, (i / m + 0.5) / m).uv);
    const double expected = pi * c.area * sum / (m * m);
    EXPECT_NEAR(lastEmitter(floorUnder(c)).power, expected, 0.005 * expected);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TexturedShape, testing::ValuesIn(cases),
                         [](const auto& row) { return std::string(row.param.name); });

/// The quarters on a mesh of 2 x 2 squares, by an attribute of its faces.
void writeQuarterFaces(const std::string& path) {
    std::ofstream file(path);
    file << "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nelement "
            "face "
            "8\nproperty list uchar int vertex_indices\nproperty float glow_r\nproperty float glow_g\nproperty float "
            "glow_b\nend_header\n";
    for (int k = 0; k < 9; ++k) file << k % 3 - 1 << " " << k / 3 - 1 << " 0\n";
    for (int k = 0; k < 4; ++k) {
        const int a = 3 * (k / 2) + k % 2;
        const double value = values[k / 2][k % 2];
        file << "3 " << a << " " << a + 1 << " " << a + 4 << " " << value << " " << value << " " << value << "\n";
        file << "3 " << a << " " << a + 4 << " " << a + 3 << " " << value << " " << value << " " << value << "\n";
    }
}

// Not held against Mitsuba: where its `path` samples emitters, attributes of meshes are black to it.
TEST(TexturedShapes, AttributesOfAMeshLightAFloorAsAnImageDoes) {
    const Case& rectangle = cases[0];
    test::SceneFiles files;
    writeQuarterFaces(files.path("quarters.ply"));
    std::string scene = floorText(
        R"(<shape type="ply"><string name="filename" value="quarters.ply"/>)" + std::string(rectangle.parameters) +
        R"(<emitter type="area"><texture type="mesh_attribute" name="radiance"><string name="name" value="face_glow_color"/></texture></emitter></shape>)");
    const Scene loaded = loadScene(files.write("scene.xml", scene));
    const double truth = floorRadiance(rectangle, valueAt);
    const double even = floorRadiance(rectangle, [](const dvec2&) { return evenValue; });
    for (const DirectLight direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = meanOfImage(loaded, direct, false);
        const double allowed = 4 * result.standardError + 0.005 * truth;
        EXPECT_NEAR(result.mean, truth, allowed) << "photons " << (direct == DirectLight::photons);
        EXPECT_GT(std::abs(result.mean - even), allowed) << "negative control";
    }
    EXPECT_NEAR(lastEmitter(loaded).power, pi * rectangle.area * evenValue, 1e-5);
}

TEST(TexturedShapes, AreSeenAsTheirTexture) {
    // From above, image to the right along +x: u to the right, v upwards; mirrored in x where it is turned about y.
    const std::pair<const char*, bool> placements[] = {
        {R"(<transform name="to_world"><translate z="0"/></transform>)", false},
        {R"(<boolean name="flip_normals" value="true"/><transform name="to_world"><rotate y="1" angle="180"/></transform>)",
         true}};
    for (const auto& [parameters, isMirrored] : placements) {
        test::SceneFiles files;
        writeQuarters(files);
        const Scene scene = loadScene(files.write(
            "scene.xml",
            R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
            <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><rfilter type="box"/>
            <integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>)" +
                emitting("rectangle", parameters) + "</scene>"));
        std::vector<int> quarter(64);
        for (int k = 0; k < 64; ++k) quarter[size_t(k)] = (k % 8 >= 4) + 2 * (k / 8 < 4);
        RenderSettings settings;
        settings.photonsPerPass = 1000;
        const auto seen = renderGroups(scene, settings, quarter, 2, 2);
        for (int k = 0; k < 4; ++k)
            EXPECT_NEAR(seen[size_t(k)].mean, values[k / 2][(k % 2) ^ int(isMirrored)], 1e-5) << k << isMirrored;
    }
}

TEST(TexturedShapes, SayWhatIsWrong) {
    test::SceneFiles files;
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string checkers = "<emitter type=\"area\">\n<texture type=\"checkerboard\" name=\"radiance\">";
    const std::pair<std::string, std::string> bad[] = {
        {"<shape type=\"obj\" id=\"m\"><string name=\"filename\" value=\"m.obj\"/>" + checkers +
             "</texture></emitter></shape>",
         "scene.xml:4:1: shape 'm' has no texture coordinates, but its emitter has a texture"},
        {"<shape type=\"obj\" id=\"m\"><string name=\"filename\" value=\"m.obj\"/><emitter type=\"area\">\n<texture "
         "type=\"mesh_attribute\" name=\"radiance\"><string name=\"name\" "
         "value=\"vertex_color\"/></texture></emitter></shape>",
         "scene.xml:4:1: shape 'm' has no attribute 'vertex_color', which a texture of its bsdf or emitter shows"}};
    for (const auto& [body, message] : bad)
        EXPECT_THAT(test::errorOf(files.write("scene.xml", test::sceneWith(body))), HasSubstr(message));
}

} // namespace
} // namespace quasilux
