// Rays of the cameras against values computed by hand and by Mitsuba, and an image of a rectangle of known extent.
#include "prepare/device_scene.h"
#include "render/renderer.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

namespace quasilux {
namespace {

Scene loadOrthographic(const std::string& parameters, unsigned width, unsigned height, const std::string& body) {
    test::SceneFiles files;
    const auto size = [](const char* name, unsigned value) {
        return std::string("<integer name=\"") + name + "\" value=\"" + std::to_string(value) + "\"/>";
    };
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"orthographic\">" + parameters +
                                                  "<film type=\"hdrfilm\"><rfilter type=\"box\"/>" +
                                                  size("width", width) + size("height", height) + "</film></sensor>" +
                                                  body + "</scene>"));
}

struct RayValues {
    glm::vec3 origin, direction;
    float tMin, tMax;
};

std::vector<RayValues> rays(shared::Camera camera) {
    camera.filterRadius = 0; // through the centres of the pixels
    Program program = testProgram("camera.cl", "-DBVH_STACK_SIZE=32 -DHAS_ORTHOGRAPHIC_CAMERA");
    Buffer<float> out(testDevice(), size_t(8) * camera.width * camera.height, "rays");
    program.kernel("cameraRays").launch(size_t(camera.width) * camera.height, camera, 0u, out);
    std::vector<RayValues> result;
    const auto v = out.read();
    for (size_t k = 0; k < v.size(); k += 8)
        result.push_back({{v[k], v[k + 1], v[k + 2]}, {v[k + 3], v[k + 4], v[k + 5]}, v[k + 6], v[k + 7]});
    return result;
}

// ---- perspective and thin lens

Scene loadView(const std::string& plugin, const std::string& parameters) {
    test::SceneFiles files;
    return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"" + plugin +
                                                  R"("><float name="fov" value="60"/>)" + parameters +
                                                  R"(<film type="hdrfilm"><integer name="width" value="40"/><integer
        name="height" value="20"/><integer name="crop_offset_x" value="8"/><integer name="crop_offset_y" value="2"/><integer
        name="crop_width" value="10"/><integer name="crop_height" value="12"/><rfilter type="box"/></film></sensor><emitter
        type="point"/></scene>)"));
}

// Corners of the image, x / z and y / z of the direction there, by Mitsuba 3.9; +x points to the left.
TEST(Perspective, CropAndPrincipalPointMoveTheViewAsInMitsuba) {
    const auto corner = [](const std::string& parameters) {
        const shared::Camera camera = flattenCamera(loadView("perspective", parameters).sensor);
        const glm::vec3 upperLeft(camera.corner.x, camera.corner.y, camera.corner.z);
        const glm::vec3 across = upperLeft + 10.f * glm::vec3(camera.stepX.x, camera.stepX.y, camera.stepX.z);
        const glm::vec3 down = upperLeft + 12.f * glm::vec3(camera.stepY.x, camera.stepY.y, camera.stepY.z);
        return std::vector<glm::vec3>{upperLeft, across, down};
    };
    const auto plain = corner("");
    test::expectNear(plain[0], {0.3464f, 0.2309f, 1}, 1e-4f);
    test::expectNear(plain[1], {0.0577f, 0.2309f, 1}, 1e-4f);
    test::expectNear(plain[2], {0.3464f, -0.1155f, 1}, 1e-4f);
    const auto moved = corner(R"(<float name="principal_point_offset_x" value="0.1"/>
                                 <float name="principal_point_offset_y" value="0.25"/>)");
    test::expectNear(moved[0], {0.2309f, 0.0866f, 1}, 1e-4f);
    test::expectNear(moved[1], {-0.0577f, 0.0866f, 1}, 1e-4f);
    test::expectNear(moved[2], {0.2309f, -0.2598f, 1}, 1e-4f);
}

/// Rays of pixel 0, through its centre, in the first passes.
std::vector<RayValues> lensRays(shared::Camera camera, unsigned passes) {
    camera.filterRadius = 0;
    Program program = testProgram("camera.cl", "-DBVH_STACK_SIZE=32 -DHAS_THIN_LENS");
    std::vector<RayValues> result;
    Buffer<float> out(testDevice(), size_t(8) * camera.width * camera.height, "rays");
    for (unsigned pass = 0; pass < passes; ++pass) {
        program.kernel("cameraRays").launch(size_t(camera.width) * camera.height, camera, pass, out);
        const auto v = out.read();
        result.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]});
    }
    return result;
}

TEST(ThinLens, RaysComeFromTheWholeLensAndMeetWhereItIsFocused) {
    const Scene scene = loadView("thinlens", R"(<float name="aperture_radius" value="0.2"/><float name="focus_distance"
        value="3"/><float name="near_clip" value="0.5"/><float name="far_clip" value="7"/>)");
    const shared::Camera camera = flattenCamera(scene.sensor);
    const float step = 2 * std::tan(glm::radians(30.f)) / 40;
    const glm::vec3 sharp = 3.f * glm::vec3((20 - 8.5f) * step, (10 - 2.5f) * step, 1);
    const auto rays = lensRays(camera, 512);
    double radius = 0, square = 0, product = 0;
    glm::dvec2 mean(0);
    for (const auto& ray : rays) {
        EXPECT_EQ(ray.origin.z, 0);
        EXPECT_LE(glm::length(ray.origin), 0.2001f);
        test::expectNear(ray.origin + ray.direction * (3 / ray.direction.z), sharp, 2e-6f);
        EXPECT_NEAR(ray.tMin * ray.direction.z, 0.5f, 1e-5f);
        EXPECT_NEAR(ray.tMax * ray.direction.z, 7, 1e-5f);
        const double r = glm::length(ray.origin) / 0.2;
        radius += r / double(rays.size());
        square += r * r / double(rays.size());
        product += double(ray.origin.x) * ray.origin.y / 0.04 / double(rays.size());
        mean += glm::dvec2(ray.origin) / 0.2 / double(rays.size());
    }
    // Of an even disc, to what 512 places of the sequence reach: independent ones would be off by 0.01 to 0.02.
    EXPECT_NEAR(radius, 2.0 / 3, 4e-3);
    EXPECT_NEAR(square, 0.5, 4e-3);
    EXPECT_NEAR(product, 0, 8e-3);
    EXPECT_NEAR(glm::length(mean), 0, 8e-3);
}

TEST(ThinLens, WithoutAnApertureIsAPinhole) {
    const Scene scene = loadView("thinlens", R"(<float name="aperture_radius" value="0"/>)");
    const shared::Camera camera = flattenCamera(scene.sensor);
    EXPECT_EQ(camera.focusDistance, 0);
    EXPECT_EQ(lensRays(camera, 1)[0].origin, glm::vec3(0));
    EXPECT_EQ(scene.sensor.focusDistance, 1e4) << "Mitsuba's default: the far clipping plane";
}

// ---- orthographic

TEST(Orthographic, RaysAreParallelAndSpacedByScaleAndPixels) {
    // Twice the size, at (1, 2, 3), looking along -z with +y up: the film covers x in [-1, 3] and y in [1, 3].
    const Scene scene = loadOrthographic(
        R"(<float name="near_clip" value="0.5"/><float name="far_clip" value="10"/><transform name="to_world">
           <scale value="2"/><lookat origin="1,2,3" target="1,2,-1" up="0,1,0"/></transform>)",
        4, 2, "<emitter type=\"point\"/>");
    const auto values = rays(flattenCamera(scene.sensor));
    ASSERT_EQ(values.size(), 8u);
    for (unsigned pixel = 0; pixel < 8; ++pixel) {
        const float x = -0.5f + static_cast<float>(pixel % 4), y = 2.5f - static_cast<float>(pixel / 4);
        test::expectNear(values[pixel].origin, {x, y, 2}); // z: 3 less twice the near clip
        test::expectNear(values[pixel].direction, {0, 0, -1});
        EXPECT_EQ(values[pixel].tMin, 0);
        EXPECT_EQ(values[pixel].tMax, 9.5f);
    }
}

// Pixels are 1/8 wide: columns from x = -1, rows down from y = 0.5.
TEST(Orthographic, RectangleCoversItsExtentAtAnyDepthUpToTheFarClip) {
    const auto image = [](const std::string& z, const std::string& farClip) {
        const Scene scene = loadOrthographic(
            R"(<transform name="to_world"><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
               <float name="far_clip" value=")" +
                farClip + "\"/>",
            16, 8,
            R"(<shape type="rectangle"><transform name="to_world"><scale x="0.5" y="0.1875"/><translate x="0.25"
               y="0.0625" z=")" +
                z + R"("/></transform><emitter type="area"><rgb name="radiance" value="3,3,3"/></emitter>
               </shape>)");
        RenderSettings settings;
        settings.photonsPerPass = 256;
        Renderer renderer(testDevice(), scene, settings);
        renderer.renderPass(0);
        return renderer.develop().radiance;
    };
    for (const char* z : {"4", "-70"}) {
        const auto radiance = image(z, "100");
        for (unsigned row = 0; row < 8; ++row)
            for (unsigned column = 0; column < 16; ++column) {
                const bool inside = column >= 6 && column < 14 && row >= 2 && row < 5;
                EXPECT_EQ(radiance[size_t(3) * (row * 16 + column)], inside ? 3 : 0) << column << ' ' << row;
            }
    }
    for (const float value : image("-70", "60")) ASSERT_EQ(value, 0) << "beyond the far clipping plane";
}

} // namespace
} // namespace quasilux
