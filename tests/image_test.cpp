// Images of all depths and channels: the values that a lookup of Mitsuba 3.9.1 gives in the middle of their pixels.
#include "support/scene_files.h"

#include <OpenImageIO/imageio.h>
#include <array>

namespace quasilux {
namespace {

using test::SceneFiles;
using test::sceneWith;

// Two pixels, (0.2, 0.4, 0.6) and (0.8, 0.1, 0.3), with alpha 0.5 and 0.25 that is no factor of the colours.
void writeTwoPixels(const std::string& path, int channels, OIIO::TypeDesc type) {
    const float all[2][4] = {{0.2f, 0.4f, 0.6f, 0.5f}, {0.8f, 0.1f, 0.3f, 0.25f}};
    std::vector<float> values;
    for (const auto& pixel : all)
        for (int c = 0; c < channels; ++c) values.push_back(channels == 2 && c == 1 ? pixel[3] : pixel[c]);
    OIIO::ImageSpec spec(2, 1, channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    if (channels == 2 || channels == 4) spec.alpha_channel = channels - 1;
    const auto file = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(file && file->open(path, spec)) << path;
    ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(file->close());
}

struct ImageCase {
    const char *name, *file;
    int channels;
    OIIO::TypeDesc::BASETYPE type;
    bool raw;
    Rgb first, second; ///< Mitsuba's
};
class Images : public testing::TestWithParam<ImageCase> {};

TEST_P(Images, AreMitsubas) {
    const ImageCase& c = GetParam();
    SceneFiles files;
    writeTwoPixels(files.path(c.file), c.channels, c.type);
    const Scene scene = loadScene(files.write(
        "scene.xml", sceneWith(std::string("<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
                                           "name=\"reflectance\"><string name=\"filename\" value=\"") +
                               c.file + "\"/><boolean name=\"raw\" value=\"" + (c.raw ? "true" : "false") +
                               "\"/></texture></bsdf></shape>")));
    const Texels& texels = scene.textures.at(0).texels;
    ASSERT_EQ(texels.size(), 2u);
    const float tolerance =
        1.f / 255; // 8 bits, rounded here and cut off there; of sRGB 1/255 is the largest step below 0.8
    test::expectNear({texels[0].r, texels[0].g, texels[0].b}, {c.first.r, c.first.g, c.first.b}, tolerance);
    test::expectNear({texels[1].r, texels[1].g, texels[1].b}, {c.second.r, c.second.g, c.second.b}, tolerance);
}

constexpr Rgb linearFirst{0.2f, 0.4f, 0.6f}, linearSecond{0.8f, 0.1f, 0.3f};
constexpr Rgb decodedFirst{0.03311f, 0.13281f, 0.31860f}, decodedSecond{0.60400f, 0.01003f, 0.07324f};
constexpr Rgb greyFirst{0.03311f, 0.03311f, 0.03311f}, greySecond{0.60400f, 0.60400f, 0.60400f};
INSTANTIATE_TEST_SUITE_P(
    Image, Images,
    testing::Values(ImageCase{"Bytes", "a.png", 3, OIIO::TypeDesc::UINT8, false, decodedFirst, decodedSecond},
                    ImageCase{"SixteenBits", "a.png", 3, OIIO::TypeDesc::UINT16, false, decodedFirst, decodedSecond},
                    ImageCase{"SixteenBitsRaw", "a.png", 3, OIIO::TypeDesc::UINT16, true, linearFirst, linearSecond},
                    ImageCase{"Alpha", "a.png", 4, OIIO::TypeDesc::UINT8, false, decodedFirst, decodedSecond},
                    ImageCase{"GreySixteenBits", "a.png", 1, OIIO::TypeDesc::UINT16, false, greyFirst, greySecond},
                    ImageCase{"GreyAndAlpha", "a.png", 2, OIIO::TypeDesc::UINT8, false, greyFirst, greySecond},
                    ImageCase{"Floats", "a.exr", 3, OIIO::TypeDesc::FLOAT, false, linearFirst, linearSecond},
                    ImageCase{"FloatsAndAlpha", "a.exr", 4, OIIO::TypeDesc::FLOAT, false, linearFirst, linearSecond},
                    ImageCase{"Halves", "a.exr", 3, OIIO::TypeDesc::HALF, true, linearFirst, linearSecond}),
    [](const auto& row) { return std::string(row.param.name); });

// Radiance pictures may be stored in eight orders: the first axis is that of the rows of the file.
TEST(RadiancePictures, AreUprightInEveryOrder) {
    for (const std::string order :
         {"-Y 2 +X 3", "-Y 2 -X 3", "+Y 2 +X 3", "+Y 2 -X 3", "+X 3 -Y 2", "-X 3 -Y 2", "+X 3 +Y 2", "-X 3 +Y 2"}) {
        SceneFiles files;
        std::string content = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + order + "\n";
        const bool byColumns = order[1] == 'X', fromRight = order.find("-X") != std::string::npos,
                   fromBottom = order.find("+Y") != std::string::npos;
        for (int k = 0; k < 6; ++k) {
            const int i = byColumns ? k / 2 : k % 3, j = byColumns ? k % 2 : k / 3;
            const int x = fromRight ? 2 - i : i, y = fromBottom ? 1 - j : j;
            const char mantissa = static_cast<char>(16 * (1 + x + 3 * y)); // of 1, 2, 3 above 4, 5, 6
            content += {mantissa, mantissa, mantissa, static_cast<char>(132)};
        }
        files.write("a.hdr", content);
        const Scene scene = loadScene(files.write("scene.xml", sceneWith(R"(<emitter type="envmap">
            <string name="filename" value="a.hdr"/></emitter>)")));
        const EnvironmentImage& image = *scene.surroundings->image;
        ASSERT_EQ(image.width, 3u) << order;
        ASSERT_EQ(image.height, 2u) << order;
        for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(image.pixels[k].r, float(k + 1), 0.04F) << order << ", " << k;
    }
}

/// The pixels of an OpenEXR file, all alike, with these channels and, if not empty, chromaticities, as linear sRGB.
Rgb pixelOf(const std::vector<std::string>& channels, const std::vector<float>& chromaticities,
            const std::array<float, 3>& values) {
    SceneFiles files;
    OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels;
    if (!chromaticities.empty())
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities.data());
    const auto file = OIIO::ImageOutput::create(files.path("a.exr"));
    EXPECT_TRUE(file && file->open(files.path("a.exr"), spec) &&
                file->write_image(OIIO::TypeDesc::FLOAT, values.data(), 0, 0, 0) && file->close());
    const Scene scene = loadScene(files.write("scene.xml", sceneWith(R"(<emitter type="envmap">
        <string name="filename" value="a.exr"/></emitter>)")));
    return scene.surroundings->image->pixels[0];
}

// Primaries of a file are taken to those of sRGB, as Mitsuba does. The values follow from the chromaticities by hand
// (SMPTE RP 177-1993): AP1, the primaries of ACEScg, without adaptation of its white.
TEST(Primaries, AreThoseOfTheFile) {
    const auto expect = [](const Rgb& found, float r, float g, float b) {
        test::expectNear({found.r, found.g, found.b}, {r, g, b}, 2e-4f);
    };
    const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};
    const std::vector<float> ap1{0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f};
    const std::vector<float> srgb{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    expect(pixelOf(rgb, {}, {0.5f, 0.25f, 0.125f}), 0.5f, 0.25f, 0.125f);
    expect(pixelOf(rgb, srgb, {0.5f, 0.25f, 0.125f}), 0.5f, 0.25f, 0.125f);
    expect(pixelOf(rgb, ap1, {0.5f, 0.4f, 0.3f}), 0.59998f, 0.38552f, 0.25711f);
    expect(pixelOf(xyz, {}, {0.950456f, 1, 1.089058f}), 1, 1, 1);
    expect(pixelOf(rgb, {1, 0, 0, 1, 0, 0, 1 / 3.f, 1 / 3.f}, {0.950456f, 1, 1.089058f}), 1, 1, 1);
}

} // namespace
} // namespace quasilux
