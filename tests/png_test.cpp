// PNG pictures: tone curve, sRGB, header.
#include "output/png.h"

#include "support/film_images.h"
#include "util/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

/// What the PNG on disk holds in its first pixel for a grey image and a curve.
TEST(Png, MapsKnownGreys) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "a.png").string();
    RenderRecord record;
    record.counters.passes = 7;
    // sRGB (IEC 61966-2-1) of the linear value, rounded: worked out by hand, not by the code under test.
    const std::vector<std::pair<float, int>> known{{0.f, 0},    {0.001f, 3},  {0.0031308f, 10},
                                                   {0.01f, 25}, {0.18f, 118}, {0.5f, 188},
                                                   {1.f, 255},  {7.f, 255},   {-1.f, 0}};
    for (const auto& [linear, expected] : known) {
        writePng(path, uniformImage(3, 2, linear / 4, 4, 0), chooseToneCurve({}, {.stops = {}, .scale = 4.0}), record);
        const auto input = OIIO::ImageInput::open(path);
        ASSERT_TRUE(input);
        EXPECT_EQ(input->spec().nchannels, 3);
        std::vector<uint8_t> pixels(18);
        ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
        EXPECT_EQ(pixels, std::vector<uint8_t>(18, static_cast<uint8_t>(expected))) << linear;
        EXPECT_EQ(input->spec().get_string_attribute("quasilux:exposureScale"), "4");
        EXPECT_EQ(input->spec().get_string_attribute("quasilux:exposureWhite"), "1");
        EXPECT_EQ(input->spec().get_string_attribute("quasilux:passes"), "7");
    }
}

TEST(ToneCurve, FollowsTheImageAndIgnoresFewBrightPixels) {
    FilmImage image = uniformImage(50, 40, 0.02f, 4, 0);
    const ToneCurve plain = chooseToneCurve(image, {});
    EXPECT_NEAR(plain.scale * 0.02, 0.8, 1e-6);
    EXPECT_EQ(plain.white, 1);
    EXPECT_EQ(toneMap(image, plain)[0], 231); // sRGB of 0.8

    for (size_t i = 0; i < 3; ++i) image.radiance[i] = 1e6f; // one pixel of 2000
    EXPECT_EQ(chooseToneCurve(image, {}).scale, plain.scale);
    EXPECT_EQ(toneMap(image, chooseToneCurve(image, {}))[3], 231);

    for (size_t i = 0; i < 60; ++i) image.radiance[i] = 1e6f; // 1 %: highlights are compressed, the rest stays visible
    const auto pixels = toneMap(image, chooseToneCurve(image, {}));
    EXPECT_EQ(pixels[0], 255);
    EXPECT_EQ(pixels[60], 178); // sRGB of 0.8 / 1.8
}

TEST(ToneCurve, StopsDoubleTheScaleAndBlackIsHandled) {
    const FilmImage image = uniformImage(4, 4, 0.3f, 4, 0);
    EXPECT_NEAR(chooseToneCurve(image, {.stops = 2.0, .scale = {}}).scale / chooseToneCurve(image, {}).scale, 4, 1e-9);
    const FilmImage black = uniformImage(4, 4, 0, 4, 0);
    EXPECT_EQ(toneMap(black, chooseToneCurve(black, {})), std::vector<uint8_t>(48, 0));
}

} // namespace
} // namespace quasilux
