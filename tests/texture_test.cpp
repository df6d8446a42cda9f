// Textures: lookups against values of Mitsuba 3.9.1 and against a reference in double, texture coordinates of every
// shape against Mitsuba's. Textures of other kinds: texture_kinds_test.
#include "prepare/device_scene.h"
#include "prepare/texture_mean.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"
#include "support/texture_tints.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

using test::down;
using test::SceneFiles;
using test::sceneWith;
using test::tintsAt;

void writeImage(const std::string& path, int width, int height, const std::vector<float>& rgb, bool bytes) {
    const auto file = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(file) << path;
    const OIIO::ImageSpec spec(width, height, 3, bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    ASSERT_TRUE(file->open(path, spec));
    ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
    ASSERT_TRUE(file->close());
}

std::vector<float> lookUp(const TextureDescription& texture, const std::vector<glm::dvec2>& uvs) {
    std::vector<float> coordinates;
    for (const auto& uv : uvs) {
        coordinates.push_back(float(uv.x));
        coordinates.push_back(float(uv.y));
    }
    Device& device = testDevice();
    static Program program = testProgram("textures.cl", "-DHAS_TEXTURES -DHAS_LOBE_LAMBERT -DBVH_STACK_SIZE=64");
    Buffer<shared::Texture> record(device, std::vector{texture.device}, "texture");
    Buffer<Rgb> texels(device, texture.texels.empty() ? Texels(std::vector<Rgb>(1)) : texture.texels, "texels");
    Buffer<float> in(device, coordinates, "uvs"), out(device, 3 * uvs.size(), "values");
    program.kernel("textureValues").launch(uvs.size(), record, texels, in, out, cl_uint(uvs.size()));
    return out.read();
}

/// The texture of the first lobe of a scene with this <texture>.
TextureDescription loadTexture(const SceneFiles& files, const std::string& type, const std::string& parameters) {
    const Scene scene = loadScene(
        files.write("scene.xml",
                    sceneWith("<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"" +
                              type + "\">" + parameters + "</texture></bsdf></shape>")));
    return scene.textures.at(scene.bsdfs.at(0).front.at(0).device.reflectanceTexture - 1);
}

constexpr glm::dvec2 mitsubaUvs[] = {{.1, .1},   {.1, .9}, {.5, .5}, {1.2, .6},  {-.1, -.1},
                                     {1.45, .3}, {0, 0},   {1, 1},   {-1.3, 2.4}};
struct MitsubaLookup {
    const char *filter, *wrap;
    float red[9]; ///< of a 3 x 2 image with 0, 0.1, 0.2 in the upper row and 0.3, 0.4, 0.5 in the lower
};
class MitsubaLookups : public testing::TestWithParam<MitsubaLookup> {};
TEST_P(MitsubaLookups, AreTheSameHere) {
    const auto& expected = GetParam();
    SceneFiles files;
    std::vector<float> pixels;
    for (int i = 0; i < 6; ++i) pixels.insert(pixels.end(), {0.1f * i, 0.1f * i + 0.01f, 0.1f * i + 0.02f});
    writeImage(files.path("a.exr"), 3, 2, pixels, false);
    const auto texture =
        loadTexture(files, "bitmap",
                    std::string("<string name=\"filename\" value=\"a.exr\"/><string name=\"filter_type\" value=\"") +
                        expected.filter + "\"/><string name=\"wrap_mode\" value=\"" + expected.wrap + "\"/>");
    const auto values = lookUp(texture, {std::begin(mitsubaUvs), std::end(mitsubaUvs)});
    for (size_t k = 0; k < 9; ++k)
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(values[3 * k + c], expected.red[k] + 0.01f * float(c), 2e-6f) << "uv " << k;
}
INSTANTIATE_TEST_SUITE_P(
    Texture, MitsubaLookups,
    testing::Values(MitsubaLookup{"nearest", "repeat", {0, .3f, .4f, .3f, .5f, .1f, 0, 0, .2f}},
                    MitsubaLookup{"nearest", "mirror", {0, .3f, .4f, .5f, 0, .1f, 0, .5f, .2f}},
                    MitsubaLookup{"nearest", "clamp", {0, .3f, .4f, .5f, 0, .2f, 0, .5f, .3f}},
                    MitsubaLookup{"bilinear", "repeat", {.13f, .25f, .25f, .22f, .37f, .115f, .25f, .25f, .25f}},
                    MitsubaLookup{"bilinear", "mirror", {0, .3f, .25f, .4f, 0, .145f, 0, .5f, .25f}},
                    MitsubaLookup{"bilinear", "clamp", {0, .3f, .25f, .41f, 0, .23f, 0, .5f, .3f}}),
    [](const auto& row) { return std::string(row.param.filter) + "_" + row.param.wrap; });

double linear(int byte) {
    const double e = byte / 255.0;
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

TEST(Texture, TheHostLooksUpAsTheKernelsDo) {
    SceneFiles files;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> range(-2, 3), value(0, 1);
    std::vector<float> pixels(3 * 5 * 4);
    for (float& pixel : pixels) pixel = value(random);
    writeImage(files.path("a.exr"), 5, 4, pixels, false);
    std::vector<glm::dvec2> uvs;
    for (int i = 0; i < 300; ++i) uvs.emplace_back(range(random), range(random));
    const std::string toUv =
        "<transform name=\"to_uv\"><scale x=\"0.7\" y=\"1.3\"/><rotate z=\"1\" angle=\"20\"/></transform>";
    std::vector<TextureDescription> textures{loadTexture(files, "checkerboard", toUv)};
    for (const std::string filter : {"nearest", "bilinear"})
        for (const std::string wrap : {"repeat", "mirror", "clamp"})
            textures.push_back(
                loadTexture(files, "bitmap",
                            "<string name=\"filename\" value=\"a.exr\"/><string name=\"filter_type\" value=\"" +
                                filter + "\"/><string name=\"wrap_mode\" value=\"" + wrap + "\"/>" + toUv));
    for (const TextureDescription& texture : textures) {
        const auto values = lookUp(texture, uvs);
        for (size_t k = 0; k < uvs.size(); ++k) {
            const glm::dvec3 host = textureValue(texture, {}, uvs[k]);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(host[c], values[3 * k + size_t(c)], 1e-5) << k;
        }
    }
}

// Bilinear and repeated, written down in double: sums over all pixels of a tent about each of its copies.
TEST(Texture, BilinearLookupsAgreeWithADoubleReference) {
    SceneFiles files;
    std::mt19937 random(1);
    constexpr int width = 5, height = 3;
    std::vector<int> bytes(3 * width * height);
    std::vector<float> pixels;
    for (int& byte : bytes) pixels.push_back(float(byte = int(random() % 256)) / 255.f);
    writeImage(files.path("a.png"), width, height, pixels, true);
    for (const bool raw : {false, true}) {
        const auto texture = loadTexture(files, "bitmap",
                                         std::string("<string name=\"filename\" value=\"a.png\"/><boolean name=\"raw\" "
                                                     "value=\"") +
                                             (raw ? "true" : "false") + "\"/>");
        std::vector<glm::dvec2> uvs;
        std::uniform_real_distribution<float> range(-2, 3);
        for (int i = 0; i < 200; ++i) uvs.emplace_back(range(random), range(random));
        const auto values = lookUp(texture, uvs);
        for (size_t k = 0; k < uvs.size(); ++k) {
            double expected = 0;
            for (int y = -3 * height; y < 4 * height; ++y)
                for (int x = -3 * width; x < 4 * width; ++x) {
                    const double wx = std::max(0.0, 1 - std::abs(uvs[k].x * width - x - 0.5));
                    const double wy = std::max(0.0, 1 - std::abs(uvs[k].y * height - y - 0.5));
                    const int byte = bytes[size_t(3 * (((y + 9) % height) * width + (x + 15) % width))];
                    expected += wx * wy * (raw ? byte / 255.0 : linear(byte));
                }
            EXPECT_NEAR(values[3 * k], expected, 5e-6) << uvs[k].x << " " << uvs[k].y;
        }
    }
}

TEST(Texture, OnePixelIsAConstant) {
    for (const char* wrap : {"repeat", "mirror", "clamp"}) {
        SceneFiles files;
        writeImage(files.path("a.png"), 1, 1, {1, 128 / 255.f, 0}, true);
        const auto texture =
            loadTexture(files, "bitmap",
                        std::string("<string name=\"filename\" value=\"a.png\"/><string name=\"wrap_mode\" value=\"") +
                            wrap + "\"/>");
        for (const glm::dvec2 uv : {glm::dvec2(0, 0), {0.5, 0.5}, {1, 1}, {-7.3, 1e9}}) {
            const auto value = lookUp(texture, {uv});
            EXPECT_FLOAT_EQ(value[0], 1);
            EXPECT_NEAR(value[1], 0.21586, 1e-5); // Mitsuba's
            EXPECT_FLOAT_EQ(value[2], 0);
        }
    }
}

// Values of Mitsuba 3.9.1.
TEST(Texture, CheckerboardIsMitsubas) {
    SceneFiles files;
    const std::vector<glm::dvec2> uvs = {{.2, .2}, {.7, .2}, {.2, .7}, {.7, .7}, {.5, .2}, {-.2, .2}, {.5, .5}};
    const auto plain = lookUp(loadTexture(files, "checkerboard", ""), uvs);
    const float expected[] = {.4f, .2f, .2f, .4f, .4f, .2f, .4f};
    for (size_t k = 0; k < uvs.size(); ++k) EXPECT_EQ(plain[3 * k], expected[k]) << k;
    const auto moved =
        lookUp(loadTexture(files, "checkerboard",
                           "<transform name=\"to_uv\"><scale x=\"2\"/><translate x=\"0.3\"/></transform>"),
               {{.2, .2}, {.05, .2}});
    EXPECT_EQ(moved[0], .2f);
    EXPECT_EQ(moved[3], .4f);
}

struct ShapeUv {
    const char* shape; ///< its attributes and parameters
    glm::vec3 from, direction;
    glm::dvec2 uv; ///< Mitsuba 3.9.1's
};
class ShapeUvs : public testing::TestWithParam<ShapeUv> {};
// A 2 x 2 image, bilinear between the middles of its pixels, that shows u in red and v in green.
TEST_P(ShapeUvs, AreMitsubas) {
    SceneFiles files;
    writeImage(files.path("uv.exr"), 2, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, false);
    files.write("q.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt .1 .2\nvt .9 .2\nvt .9 .7\nf 1/1 2/2 3/3\n");
    for (const char* names : {"u v", "s t"})
        files.write(std::string(1, names[0]) + ".ply",
                    std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                "property float z\nproperty float ") +
                        names[0] + "\nproperty float " + names[2] +
                        "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0 .1 .2\n"
                        "1 -1 0 .9 .2\n1 1 0 .9 .7\n3 0 1 2\n");
    const auto& expected = GetParam();
    const std::string texture =
        "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\"><string "
        "name=\"filename\" value=\"uv.exr\"/><transform name=\"to_uv\"><scale value=\"0.5\"/><translate x=\"0.25\" "
        "y=\"0.25\"/></transform></texture></bsdf></bsdf>";
    const Scene scene = loadScene(
        files.write("scene.xml", sceneWith(std::string("<shape type=") + expected.shape + texture + "</shape>")));
    const glm::vec3 tint = tintsAt(scene, {{expected.from, expected.direction}}).at(0);
    EXPECT_NEAR(tint.x, expected.uv.x, 4e-6);
    EXPECT_NEAR(tint.y, expected.uv.y, 4e-6);
}
INSTANTIATE_TEST_SUITE_P(
    Texture, ShapeUvs,
    testing::Values(
        ShapeUv{"\"rectangle\">", {.5, -.2, 2}, down, {.75, .4}},
        ShapeUv{"\"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/>", {.5, -.2, 2}, down, {.75, .4}},
        ShapeUv{
            "\"rectangle\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>", {.5, -.2, 2}, down, {.25, .4}},
        ShapeUv{"\"cube\">", {3, .5, -.2}, {-1, 0, 0}, {.75, .6}},
        ShapeUv{"\"cube\">", {-3, .5, -.2}, {1, 0, 0}, {.75, .4}},
        ShapeUv{"\"cube\">", {-.2, 3, .5}, {0, -1, 0}, {.6, .25}},
        ShapeUv{"\"cube\">", {-.2, -3, .5}, {0, 1, 0}, {.75, .4}}, ShapeUv{"\"cube\">", {.5, -.2, 3}, down, {.4, .75}},
        ShapeUv{"\"cube\">", {.5, -.2, -3}, {0, 0, 1}, {.6, .75}},
        ShapeUv{
            "\"cube\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>", {3, .5, -.2}, {-1, 0, 0}, {.75, .4}},
        ShapeUv{"\"sphere\">", {3, 3, 3}, {-1, -1, -1}, {.125, .304087}},
        ShapeUv{"\"sphere\">", {-3, 1.5, .9}, {3, -1.5, -.9}, {.426208, .416554}},
        ShapeUv{"\"sphere\">", {-.6, -3, -1.5}, {.6, 3, 1.5}, {.718584, .645101}},
        ShapeUv{"\"sphere\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>",
                {-.6, -3, -1.5},
                {.6, 3, 1.5},
                {.781416, .645101}},
        ShapeUv{"\"obj\"><string name=\"filename\" value=\"q.obj\"/>", {.5, -.2, 2}, down, {.7, .6}},
        ShapeUv{
            "\"obj\"><string name=\"filename\" value=\"q.obj\"/><boolean name=\"flip_tex_coords\" value=\"false\"/>",
            {.5, -.2, 2},
            down,
            {.7, .4}},
        ShapeUv{"\"ply\"><string name=\"filename\" value=\"u.ply\"/>", {.5, -.2, 2}, down, {.7, .4}},
        ShapeUv{"\"ply\"><string name=\"filename\" value=\"s.ply\"/><boolean name=\"flip_tex_coords\" value=\"true\"/>",
                {.5, -.2, 2},
                down,
                {.7, .6}}));

} // namespace
} // namespace quasilux
