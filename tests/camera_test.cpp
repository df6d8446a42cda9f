// Rays of the orthographic camera against values computed by hand, and an image of a rectangle of known extent.
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
