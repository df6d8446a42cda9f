// Pictures in terminals: what is sent by the sixel and the kitty protocol, decoded. Nothing is left to chance.
#include "cli/terminal_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace quasilux {
namespace {

ShownPicture colourful() {
    ShownPicture picture{7, 9, {}};
    for (unsigned k = 0; k < 7 * 9 * 3; ++k) picture.pixels.push_back(static_cast<uint8_t>(k * 1361 % 256));
    return picture;
}

/// Levels of 51 that a sixel text draws: the ones of every pixel and channel.
std::vector<int> decodedSixels(const std::string& text, unsigned width, unsigned height) {
    std::vector<int> levels(size_t(width) * height * 3, -1);
    const std::string start = "\033Pq\"1;1;" + std::to_string(width) + ";" + std::to_string(height);
    EXPECT_EQ(text.rfind(start, 0), 0u);
    std::map<int, std::array<int, 3>> palette;
    int colour = -1;
    unsigned x = 0, top = 0;
    const auto number = [&](size_t& at) {
        int value = 0;
        for (; at < text.size() && std::isdigit(text[at]); ++at) value = 10 * value + (text[at] - '0');
        return value;
    };
    for (size_t at = start.size(); at < text.size() && text[at] != '\033';) {
        int repeat = 1;
        const char sign = text[at++];
        if (sign == '#') {
            colour = number(at);
            if (text[at] != ';') continue;
            std::vector<int> parts;
            while (text[at] == ';') parts.push_back(number(++at));
            palette[colour] = {parts.at(1) / 20, parts.at(2) / 20, parts.at(3) / 20};
            continue;
        }
        if (sign == '$' || sign == '-') {
            x = 0;
            top += sign == '-' ? 6 : 0;
            continue;
        }
        if (sign == '!') repeat = number(at);
        const int bits = (sign == '!' ? text[at++] : sign) - '?';
        for (; repeat > 0; --repeat, ++x)
            for (unsigned row = 0; row < 6; ++row)
                if (bits >> row & 1)
                    for (unsigned c = 0; c < 3; ++c) {
                        EXPECT_LT(x, width);
                        EXPECT_LT(top + row, height);
                        levels.at(3 * (size_t(top + row) * width + x) + c) = palette.at(colour).at(c);
                    }
    }
    return levels;
}

TEST(Sixel, DrawsEveryPixelInTheNearestColoursOfThePalette) {
    const ShownPicture picture = colourful();
    const auto levels = decodedSixels(sixelText(picture), picture.width, picture.height);
    for (size_t k = 0; k < levels.size(); ++k) EXPECT_LT(std::abs(51 * levels[k] - picture.pixels[k]), 51) << k;
    // Dithering keeps means: of a grey halfway between two levels half the pixels are brighter.
    const ShownPicture grey{8, 8, std::vector<uint8_t>(8 * 8 * 3, 51 * 2 + 26)};
    double sum = 0;
    for (const int level : decodedSixels(sixelText(grey), 8, 8)) sum += 51 * level;
    EXPECT_NEAR(sum / (8 * 8 * 3), 51 * 2 + 26, 2);
}

/// What pieces of kitty's protocol hold, decoded from base64.
std::vector<unsigned char> decodedKitty(const std::string& text) {
    std::string data;
    for (size_t at = text.find("\033_G"); at != std::string::npos; at = text.find("\033_G", at + 1)) {
        const size_t from = text.find(';', at) + 1, end = text.find("\033\\", from);
        EXPECT_LE(end - from, 4096u);
        EXPECT_NE(text.substr(at, from - at).find(text.find("\033_G", end) == std::string::npos ? "m=0" : "m=1"),
                  std::string::npos);
        data += text.substr(from, end - from);
    }
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned group = 0, count = 0;
    for (const char c : data) {
        if (c == '=') break;
        group = group << 6 | static_cast<unsigned>(digits.find(c));
        if (++count % 4 != 1) bytes.push_back(static_cast<unsigned char>(group >> (6 - 2 * ((count - 1) % 4)) & 255));
    }
    return bytes;
}

TEST(Kitty, HoldsThePictureAsPng) {
    ShownPicture picture{64, 64, {}}; // of more than one piece
    std::mt19937 random(3);
    for (unsigned k = 0; k < 64 * 64 * 3; ++k) picture.pixels.push_back(static_cast<uint8_t>(random() & 255));
    const std::string text = kittyText(picture);
    EXPECT_EQ(text.rfind("\033_Ga=T,f=100,m=1;", 0), 0u);
    std::vector<unsigned char> bytes = decodedKitty(text);
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::open("a.png", nullptr, &memory);
    ASSERT_TRUE(input);
    std::vector<uint8_t> pixels(64 * 64 * 3);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
    EXPECT_EQ(pixels, picture.pixels);
}

} // namespace
} // namespace quasilux
