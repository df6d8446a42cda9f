// Images of all depths and channels: the values that a lookup of Mitsuba 3.9.1 gives in the middle of their pixels.
#include "support/scene_files.h"

#include <OpenImageIO/imageio.h>

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

} // namespace
} // namespace quasilux
