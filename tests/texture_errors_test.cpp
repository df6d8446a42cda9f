// What is wrong with a texture is said at file:line:column.
#include "prepare/device_scene.h"
#include "support/scene_files.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::SceneFiles;
using test::sceneWith;
using testing::HasSubstr;

void writeFloats(const std::string& path, int width, const std::vector<float>& rgb) {
    const auto file = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(file->open(path, OIIO::ImageSpec(width, 1, 3, OIIO::TypeDesc::FLOAT)));
    ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
    ASSERT_TRUE(file->close());
}

/// A rectangle of this bsdf; the texture stands in line 5.
std::string withTexture(const std::string& bsdf, const std::string& texture) {
    return sceneWith("<shape type=\"rectangle\"><bsdf type=\"" + bsdf + "\">\n" + texture + "</bsdf></shape>");
}
std::string bitmap(const std::string& file) {
    return "<texture type=\"bitmap\" name=\"reflectance\">\n<string name=\"filename\" value=\"" + file +
           "\"/></texture>";
}

struct Case {
    const char *name, *bsdf, *texture, *place, *message;
};
class TextureErrors : public testing::TestWithParam<Case> {};
TEST_P(TextureErrors, AreSaid) {
    SceneFiles files;
    files.write("text.png", "this is no picture");
    writeFloats(files.path("negative.exr"), 2, {0.5f, 0.5f, 0.5f, 0.5f, -0.5f, 0.5f});
    const auto& c = GetParam();
    const std::string texture = c.texture[0] == '<' ? c.texture : bitmap(c.texture);
    const std::string error = test::errorOf(files.write("scene.xml", withTexture(c.bsdf, texture)));
    EXPECT_THAT(error, HasSubstr(std::string("scene.xml:") + c.place));
    EXPECT_THAT(error, HasSubstr(c.message));
}
INSTANTIATE_TEST_SUITE_P(
    Texture, TextureErrors,
    testing::Values(
        Case{"MissingFile", "diffuse", "none.png", "6:1", "there is no such file"},
        Case{"NoImage", "diffuse", "text.png", "6:1", "cannot read the image"},
        Case{"Negative", "diffuse", "negative.exr", "6:1", "pixel 1, 0 has the value -0.5"},
        Case{"NoFile", "diffuse", "<texture type=\"bitmap\" name=\"reflectance\"/>", "5:1", "filename"},
        Case{"Plugin", "diffuse", "<texture type=\"bitmpa\" name=\"reflectance\"/>", "5:1", "Did you mean 'bitmap'"},
        Case{"Parameter", "diffuse",
             "<texture type=\"checkerboard\" name=\"reflectance\">\n<float name=\"colour0\" value=\"1\"/></texture>",
             "6:1", "unknown parameter 'colour0'"},
        Case{"Filter", "diffuse",
             "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"a\"/>\n<string "
             "name=\"filter_type\" value=\"cubic\"/></texture>",
             "6:1", "unknown value 'cubic'"},
        Case{"AboveOne", "diffuse",
             "<texture type=\"checkerboard\" name=\"reflectance\">\n<float name=\"color0\" value=\"1.5\"/></texture>",
             "6:1", "within [0, 1]"},
        Case{"WrongName", "diffuse", "<texture type=\"checkerboard\" name=\"color\"/>", "5:1",
             "takes no texture as 'color'. Parameters of it that may be textures: reflectance"},
        Case{"NoName", "diffuse", "<texture type=\"checkerboard\"/>", "5:1", "without a name"},
        Case{"Exponent", "phong", "<texture type=\"checkerboard\" name=\"exponent\"/>", "5:1",
             "takes no texture as 'exponent'"},
        Case{"Twice", "diffuse",
             "<float name=\"reflectance\" value=\"1\"/>\n<texture type=\"checkerboard\" name=\"reflectance\"/>", "6:1",
             "is given twice"},
        Case{"PhongSum", "phong",
             "<texture type=\"checkerboard\" name=\"diffuse_reflectance\"><float name=\"color0\" "
             "value=\"0.9\"/></texture>",
             "4:", "more light would leave"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(TextureErrors, MeshWithoutCoordinates) {
    SceneFiles files;
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3\n");
    const auto error = test::errorOf(files.write(
        "scene.xml",
        sceneWith("\n<shape type=\"obj\" id=\"m\"><string name=\"filename\" value=\"m.obj\"/><bsdf "
                  "type=\"diffuse\"><texture type=\"checkerboard\" name=\"reflectance\"/></bsdf></shape>")));
    EXPECT_THAT(error, HasSubstr("scene.xml:5:1: shape 'm' has no texture coordinates"));
}

TEST(Textures, BrightPixelsAreClampedWithAWarning) {
    SceneFiles files;
    writeFloats(files.path("bright.exr"), 2, {0.5f, 2, 0.25f, 0.5f, 0.5f, 0.5f});
    const Scene scene = loadScene(files.write("scene.xml", withTexture("diffuse", bitmap("bright.exr"))));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("scene.xml:6:1: 1 of the 2 pixels of 'bright.exr' are above 1"));
    EXPECT_EQ(scene.textures.at(0).texels.at(0).g, 1);
    EXPECT_EQ(scene.textures.at(0).texels.at(0).b, 0.25f);
}

TEST(Textures, AnImageIsHeldOnceHoweverManyTexturesShowIt) {
    SceneFiles files;
    writeFloats(files.path("a.exr"), 2, {0.5f, 0.4f, 0.25f, 0.5f, 0.5f, 0.5f});
    const auto shape = [&](const char* name, const char* parameters) {
        return std::string("<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
                           "name=\"reflectance\"><string name=\"filename\" value=\"") +
               name + "\"/>" + parameters + "</texture></bsdf></shape>";
    };
    writeFloats(files.path("b.exr"), 2, {0.1f, 0.4f, 0.25f, 0.5f, 0.5f, 0.5f});
    const Scene scene = loadScene(
        files.write("scene.xml", sceneWith(shape("a.exr", "") + shape("b.exr", "") +
                                           shape("a.exr", "<string name=\"filter_type\" value=\"nearest\"/>"))));
    ASSERT_EQ(scene.textures.size(), 3u);
    EXPECT_EQ(scene.textures[0].texels.identity(), scene.textures[2].texels.identity());
    MaterialTables materials;
    materials.lobes.resize(3);
    for (unsigned k = 0; k < 3; ++k) materials.lobes[k].reflectanceTexture = k + 1;
    const TextureTables tables = flattenTextures(scene, materials, {});
    EXPECT_EQ(tables.texels.size(), 4u); // two images of two pixels
    EXPECT_EQ(tables.textures[0].firstTexel, tables.textures[2].firstTexel);
    EXPECT_EQ(tables.texels[tables.textures[1].firstTexel].r, 0.1f);
    EXPECT_EQ(tables.textures[2].filter, TEXTURE_NEAREST);
}

TEST(Textures, ASharedOneIsReadOnceAndAnUnusedOneIsReported) {
    const Scene scene = test::loadBody(
        "<texture type=\"checkerboard\" id=\"t\"/><texture type=\"checkerboard\" id=\"idle\"/>"
        "<shape type=\"rectangle\"><bsdf type=\"dielectric\"><ref id=\"t\" name=\"specular_reflectance\"/>"
        "<ref id=\"t\" name=\"specular_transmittance\"/></bsdf></shape>");
    ASSERT_EQ(scene.textures.size(), 1u);
    const auto& lobe = scene.bsdfs.at(0).back.at(0).device;
    EXPECT_EQ(lobe.reflectanceTexture, 1u);
    EXPECT_EQ(lobe.transmittanceTexture, 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("texture 'idle' is used by no bsdf"));
}

} // namespace
} // namespace quasilux
