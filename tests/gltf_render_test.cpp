// A glTF file renders as the XML that says the same: to the bit, as both come to the same scene.
#include "support/gltf_files.h"
#include "support/image_difference.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include "render/renderer.h"

#include <fmt/format.h>
#include <numbers>

namespace quasilux {
namespace {

using nlohmann::json;

constexpr double yfov = 0.8;

/// A shiny plate below a lamp that emits from its front, and a spot.
std::string gltfScene(double roughness) {
    test::GltfFile file;
    file.add("materials",
             {{"pbrMetallicRoughness",
               {{"baseColorFactor", {0.8, 0.5, 0.25, 1}}, {"metallicFactor", 0.5}, {"roughnessFactor", roughness}}}});
    file.add("materials", {{"emissiveFactor", {1, 1, 1}},
                           {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}});
    file.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"aspectRatio", 1}, {"znear", 0.01}}}});
    file.addNode({{"mesh", file.addSquare({{"material", 0}})}});
    file.addNode({{"mesh", file.addSquare({{"material", 1}})},
                  {"matrix", {0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, -1, 0, 0, 1, 2, 1}}});
    file.addLight({{"type", "spot"}, {"intensity", 5}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
                  {{"translation", {0, 0, 3}}});
    file.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
    return file.binary();
}

std::string xmlScene() {
    const auto number = [](const char* name, double value) {
        return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
    };
    const auto square = [](const std::string& content) {
        return "<shape type=\"ply\"><string name=\"filename\" value=\"square.ply\"/><boolean name=\"face_normals\" "
               "value=\"true\"/>" +
               content + "</shape>";
    };
    const auto principled = [&](const std::string& color, double metallic, double roughness) {
        return "<bsdf type=\"principled\"><rgb name=\"base_color\" value=\"" + color + "\"/>" +
               number("metallic", metallic) + number("roughness", roughness) + number("eta", 1.5) + "</bsdf>";
    };
    const auto matrix = [](const std::string& rows) {
        return "<transform name=\"to_world\"><matrix value=\"" + rows + "\"/></transform>";
    };
    const double degrees = 180 / std::numbers::pi;
    return "<scene version=\"3.0.0\"><?quasilux units=\"photometric\"?>" +
           square(principled("0.8,0.5,0.25", 0.5, 0.5)) +
           square(matrix("0.5 0 0 0  0 -0.5 0 1  0 0 -1 2  0 0 0 1") + principled("1", 0, 1) +
                  "<emitter type=\"area\"><rgb name=\"radiance\" value=\"8\"/></emitter>") +
           "<emitter type=\"spot\">" + matrix("1 0 0 0  0 -1 0 0  0 0 -1 3  0 0 0 1") +
           "<rgb name=\"intensity\" value=\"5\"/>" + number("cutoff_angle", 0.5 * degrees) +
           number("beam_width", 0.25 * degrees) + "</emitter><sensor type=\"perspective\">" +
           number("fov", yfov * degrees) + number("far_clip", 1e4) + number("near_clip", 0.01) +
           "<string name=\"fov_axis\" value=\"y\"/>" + matrix("-1 0 0 0  0 1 0 0  0 0 -1 5  0 0 0 1") +
           "<film type=\"hdrfilm\"><integer name=\"width\" value=\"768\"/><integer name=\"height\" "
           "value=\"768\"/></film>"
           "</sensor></scene>";
}

constexpr const char* squarePly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float u\nproperty float v\nelement face 2\nproperty list uchar int "
    "vertex_indices\nend_header\n-1 -1 0 0 1\n1 -1 0 1 1\n1 1 0 1 0\n-1 1 0 0 0\n3 0 1 2\n3 0 2 3\n";

std::vector<float> radianceOf(Scene scene) {
    scene.sensor.width = scene.sensor.height = scene.sensor.filmWidth = scene.sensor.filmHeight = 24;
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 2; ++pass) renderer.renderPass(pass);
    return renderer.develop().radiance;
}

TEST(GltfRender, IsThatOfXml) {
    test::SceneFiles files;
    files.write("square.ply", squarePly);
    const auto xml = radianceOf(loadScene(files.write("scene.xml", xmlScene())));
    const auto same = radianceOf(loadScene(files.write("scene.glb", gltfScene(0.5))));
    ASSERT_GT(*std::max_element(xml.begin(), xml.end()), 0);
    EXPECT_EQ(largestDifference(same, xml), 0);
    // Control: another roughness is another image.
    EXPECT_GT(largestDifference(radianceOf(loadScene(files.write("scene.glb", gltfScene(0.6)))), xml), 0.01);
}

} // namespace
} // namespace quasilux
