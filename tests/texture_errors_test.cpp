// What is wrong with a texture is said at file:line:column.
#include "prepare/device_scene.h"
#include "support/scene_files.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <sstream>

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
        Case{
            "AttributeName", "diffuse",
            "<texture type=\"mesh_attribute\" name=\"reflectance\">\n<string name=\"name\" value=\"color\"/></texture>",
            "6:1", "value=\"vertex_…\"/>"},
        Case{"PhongSum", "phong",
             "<texture type=\"checkerboard\" name=\"diffuse_reflectance\"><float name=\"color0\" "
             "value=\"0.9\"/></texture>",
             "4:", "more light would leave"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(TextureErrors, MeshWithoutCoordinates) {
    SceneFiles files;
    const std::string shape = "\n<shape type=\"obj\" id=\"m\"><string name=\"filename\" value=\"m.obj\"/><bsdf "
                              "type=\"diffuse\">";
    const std::string plain = files.write("plain.xml", sceneWith(shape + "</bsdf></shape>"));
    const std::string textured = files.write(
        "scene.xml", sceneWith(shape + "<texture type=\"checkerboard\" name=\"reflectance\"/></bsdf></shape>"));
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1 2 3\n");
    EXPECT_THAT(test::errorOf(textured), HasSubstr("scene.xml:5:1: shape 'm' has no texture coordinates, but"));
    // As in Mitsuba, where those that a corner lacks are whatever was in memory.
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.75\nf 1/1 2/1 3\nf 3 2 1/1\n");
    const Scene scene = loadScene(textured);
    const std::vector<glm::vec2> expected{{.5f, .25f}, {.5f, .25f}, {0, 0}, {0, 0}, {0, 0}, {.5f, .25f}};
    EXPECT_EQ(scene.shapes.at(0).mesh.cornerUvs, expected);
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr(
                                    "scene.xml:5:1: shape 'm' has no texture coordinates at 3 of its 6 corners, but "
                                    "its bsdf has a texture; they are taken as (0, 0).")));
    EXPECT_THAT(loadScene(plain).warnings, testing::IsEmpty());
}

/// A triangle with these properties of its vertices, and of itself, beside their places.
std::string plyWith(const std::string& properties, const std::string& values, const std::string& ofFace = "",
                    const std::string& valuesOfFace = "") {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "element face 1\nproperty list uchar int vertex_indices\n" + ofFace + "end_header\n0 0 0 " +
           values + "\n1 0 0 " + values + "\n0 1 0 " + values + "\n3 0 1 2 " + valuesOfFace + "\n";
}
std::string three(const std::string& type, const std::string& names) {
    std::string lines;
    std::istringstream in(names);
    for (std::string name; in >> name;) lines += "property " + type + " " + name + "\n";
    return lines;
}
/// m.ply with this attribute shown; the shape stands in line 4.
std::string showing(const std::string& attribute, const std::string& scale = "1") {
    return sceneWith(
        "<shape type=\"ply\" id=\"m\"><string name=\"filename\" value=\"m.ply\"/><bsdf type=\"diffuse\">\n<texture "
        "type=\"mesh_attribute\" name=\"reflectance\"><string name=\"name\" value=\"" +
        attribute + "\"/><float name=\"scale\" value=\"" + scale + "\"/></texture></bsdf></shape>");
}

struct AttributeCase {
    const char *name, *type, *properties, *values, *attribute;
    unsigned channels;
    float expected[3];
};
class MeshAttributes : public testing::TestWithParam<AttributeCase> {};
// Names and values of Mitsuba 3.9.1, of vertices and of faces.
TEST_P(MeshAttributes, AreMitsubas) {
    const auto& c = GetParam();
    for (const std::string kind : {"vertex_", "face_"}) {
        SceneFiles files;
        const std::string lines = three(c.type, c.properties);
        files.write("m.ply", kind == "face_" ? plyWith("", "", lines, c.values) : plyWith(lines, c.values));
        const Scene scene = loadScene(files.write("scene.xml", showing(kind + c.attribute)));
        const auto& attributes = scene.shapes.at(0).mesh.attributes;
        ASSERT_EQ(attributes.size(), 1u);
        EXPECT_EQ(attributes[0].name, kind + c.attribute);
        EXPECT_EQ(attributes[0].channels, c.channels);
        ASSERT_EQ(attributes[0].values.size(), kind == "face_" ? 1u : 3u);
        const Rgb value = attributes[0].values.back();
        EXPECT_NEAR(value.r, c.expected[0], 1e-6);
        EXPECT_NEAR(value.g, c.expected[1], 1e-6);
        EXPECT_NEAR(value.b, c.expected[2], 1e-6);
    }
}
INSTANTIATE_TEST_SUITE_P(
    Ply, MeshAttributes,
    testing::Values(
        AttributeCase{"Rgb", "float", "r g b", ".1 .2 .3", "color", 3, {.1f, .2f, .3f}},
        AttributeCase{"AnyOrder", "float", "b r g", ".1 .2 .3", "color", 3, {.2f, .3f, .1f}},
        AttributeCase{"Alpha", "float", "red green blue alpha", ".1 .2 .3 .4", "color", 3, {.1f, .2f, .3f}},
        AttributeCase{"Double", "double", "a_r a_g a_b", ".1 .2 .3", "a_color", 3, {.1f, .2f, .3f}},
        AttributeCase{"LongName", "float", "my_own_x my_own_y my_own_z", ".1 .2 .3", "my_own", 3, {.1f, .2f, .3f}},
        AttributeCase{"FromZero", "float", "q_0 q_1 q_2", ".1 .2 .3", "q", 3, {.1f, .2f, .3f}},
        AttributeCase{"FromOne", "float", "q_1 q_2 q_3", ".1 .2 .3", "q", 3, {.1f, .2f, .3f}},
        AttributeCase{"OneChannel", "float", "other w_x", ".9 .1", "w", 1, {.1f, .1f, .1f}},
        AttributeCase{"OneRed", "float", "w_r", ".1", "w_color", 1, {.1f, .1f, .1f}},
        AttributeCase{"Neighbours", "float", "a_x b_x b_y b_z", ".9 .1 .2 .3", "b", 3, {.1f, .2f, .3f}},
        AttributeCase{"Bytes", "uchar", "red green blue", "255 128 0", "color", 3, {255, 128, 0}},
        AttributeCase{"Signed", "char", "red green blue", "127 64 0", "color", 3, {1, .217703f, 0}},
        AttributeCase{"Shorts", "ushort", "red green blue", "65535 32768 0", "color", 3, {1, .214048f, 0}},
        AttributeCase{"Integers", "int", "red green blue", "2147483647 1073741824 0", "color", 3, {1, .214041f, 0}}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(MeshAttributes, OfAShapeThatLacksThemAreSaid) {
    SceneFiles files;
    files.write("m.ply", plyWith(three("float", "r g b q_x q_y"), ".1 .2 .3 .4 .5", three("float", "w_x"), ".5"));
    EXPECT_THAT(test::errorOf(files.write("scene.xml", showing("vertex_colour"))),
                HasSubstr("scene.xml:4:1: shape 'm' has no attribute 'vertex_colour', which a texture of its bsdf or "
                          "emitter shows. It "
                          "has: vertex_color, face_w."));
    const std::string error = test::errorOf(files.write(
        "scene.xml",
        withTexture("diffuse", "<texture type=\"mesh_attribute\" name=\"reflectance\"><string name=\"name\" "
                               "value=\"face_w\"/></texture>")));
    EXPECT_THAT(error, HasSubstr("scene.xml:4:1: shape 'rectangle@4' has no attribute 'face_w'"));
    EXPECT_THAT(error, HasSubstr("It has none; those of the vertices and faces of PLY files are read"));
}

TEST(MeshAttributes, ThatAreNoReflectancesAreSaid) {
    SceneFiles files;
    files.write("m.ply", plyWith(three("float", "r g b"), ".1 .2 1.5"));
    EXPECT_THAT(
        test::errorOf(files.write("scene.xml", showing("vertex_color", "-2"))),
        HasSubstr(
            "scene.xml:4:1: attribute 'vertex_color' of shape 'm', times the texture's scale, is -0.2 at vertex 0"));
    const Scene bright = loadScene(files.write("scene.xml", showing("vertex_color")));
    ASSERT_EQ(bright.warnings.size(), 1u);
    EXPECT_THAT(bright.warnings[0],
                HasSubstr("scene.xml:4:1: 3 of the 3 values of attribute 'vertex_color' are above 1"));
    EXPECT_TRUE(loadScene(files.write("scene.xml", showing("vertex_color", "0.5"))).warnings.empty());
}

TEST(MeshAttributes, AsWeightsHaveOneChannel) {
    SceneFiles files;
    files.write("m.ply", plyWith(three("float", "r g b w_x"), ".1 .2 .3 .4"));
    const auto mask = [&](const std::string& attribute) {
        return files.write(
            "scene.xml",
            sceneWith("<shape type=\"ply\" id=\"m\"><string name=\"filename\" value=\"m.ply\"/><bsdf "
                      "type=\"mask\"><texture type=\"mesh_attribute\" name=\"opacity\"><string name=\"name\" "
                      "value=\"" +
                      attribute + "\"/></texture><bsdf type=\"diffuse\"/></bsdf></shape>"));
    };
    EXPECT_THAT(
        test::errorOf(mask("vertex_color")),
        HasSubstr("scene.xml:4:1: attribute 'vertex_color' of shape 'm' has 3 channels, but a number is wanted"));
    EXPECT_EQ(loadScene(mask("vertex_w")).shapes.at(0).mesh.attributes.at(0).values.at(0).g, .4f);
}

TEST(Textures, OneWithinItselfIsSaid) {
    SceneFiles files;
    const std::string board = "<texture type=\"checkerboard\" id=\"t\"><ref id=\"t\" name=\"color0\"/></texture>\n";
    EXPECT_THAT(test::errorOf(files.write(
                    "scene.xml", sceneWith(board + "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><ref id=\"t\" "
                                                   "name=\"reflectance\"/></bsdf></shape>"))),
                HasSubstr("scene.xml:4:1: texture 't' contains itself"));
}

TEST(Textures, ARawConstantIsANumberOrAVector) {
    const auto inDiffuse = [](const std::string& value) {
        return withTexture("diffuse", "<texture type=\"rawconstant\" name=\"reflectance\">\n" + value + "</texture>");
    };
    SceneFiles files;
    const auto reflectance = [&](const std::string& value) {
        return loadScene(files.write("scene.xml", inDiffuse(value))).bsdfs.at(0).front.at(0).device.reflectance;
    };
    EXPECT_EQ(reflectance("<float name=\"value\" value=\"0.3\"/>").b, 0.3f);
    const Rgb vector = reflectance("<vector name=\"value\" value=\"0.1,0.2,0.9\"/>");
    EXPECT_EQ(vector.r, 0.1f);
    EXPECT_EQ(vector.g, 0.2f);
    EXPECT_EQ(vector.b, 0.9f);
    const auto error = [&](const std::string& scene) { return test::errorOf(files.write("scene.xml", scene)); };
    EXPECT_THAT(error(inDiffuse("<rgb name=\"value\" value=\"0.1\"/>")), HasSubstr("scene.xml:6:1:"));
    EXPECT_THAT(error(inDiffuse("<float name=\"value\" value=\"1.5\"/>")), HasSubstr("within [0, 1]"));
    EXPECT_THAT(error(inDiffuse("")), HasSubstr("scene.xml:5:1: texture 'rawconstant' needs the parameter 'value'"));
    EXPECT_THAT(
        error(withTexture("roughconductor", "<texture type=\"rawconstant\" name=\"alpha\"><vector name=\"value\" "
                                            "value=\"0.1,0.2,0.3\"/></texture>")),
        HasSubstr("scene.xml:5:1: parameter 'alpha' of bsdf 'roughconductor' is a number"));
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
    ASSERT_EQ(tables.images.size(), 2u); // of two pixels each
    EXPECT_EQ(tables.textures[1].firstTexel % 2, 0u);
    EXPECT_EQ(tables.textures[0].firstTexel, tables.textures[2].firstTexel);
    EXPECT_EQ(tables.images[tables.textures[1].firstTexel / 2].at(0).r, 0.1f);
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
