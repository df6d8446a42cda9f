#include "cli/terminal_picture.h"

#include "compare/error_picture.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <unistd.h>

namespace quasilux {

namespace {

constexpr unsigned longestShown = 640;
constexpr size_t kittyChunk = 4096;   // characters of base64 that the protocol takes at once
constexpr unsigned channelLevels = 6; // of a channel of the palette
constexpr unsigned sixelRows = 6;

// Of a pixel, with the thresholds of Bayer's matrix of 4 x 4.
unsigned paletteColour(const ShownPicture& picture, unsigned x, unsigned y) {
    constexpr std::array<unsigned, 16> bayer{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const unsigned threshold = bayer[(y % 4) * 4 + x % 4];
    unsigned colour = 0;
    for (unsigned c = 0; c < 3; ++c) {
        const unsigned value = picture.pixels[3 * (size_t(y) * picture.width + x) + c] * (channelLevels - 1);
        const unsigned low = value / 255, rest = value % 255;
        colour = colour * channelLevels + low + (rest * 16 > (2 * threshold + 1) * 255 / 2 ? 1 : 0);
    }
    return colour;
}

// So many of the same sign; short runs are written out.
void append(std::string& text, char sign, unsigned count) {
    if (count > 3)
        text += fmt::format("!{}{}", count, sign);
    else
        text.append(count, sign);
}

// Six rows, one colour after the other over them.
void appendBand(std::string& text, const ShownPicture& picture, unsigned top) {
    const unsigned rows = std::min(sixelRows, picture.height - top);
    std::vector<std::vector<uint8_t>> bits(channelLevels * channelLevels * channelLevels);
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned x = 0; x < picture.width; ++x) {
            auto& column = bits[paletteColour(picture, x, top + row)];
            column.resize(picture.width);
            column[x] = static_cast<uint8_t>(column[x] | 1u << row);
        }
    for (size_t colour = 0; colour < bits.size(); ++colour) {
        if (bits[colour].empty()) continue;
        text += fmt::format("#{}", colour);
        for (unsigned x = 0; x < picture.width;) {
            unsigned end = x + 1;
            while (end < picture.width && bits[colour][end] == bits[colour][x]) ++end;
            append(text, static_cast<char>('?' + bits[colour][x]), end - x);
            x = end;
        }
        text += '$'; // back to the left
    }
    text += '-'; // next band
}

} // namespace

std::string kittyText(const ShownPicture& picture) {
    const std::string uri = pngDataUri(picture.pixels, picture.width, picture.height),
                      data = uri.substr(uri.find(',') + 1);
    std::string text;
    for (size_t from = 0; from < data.size(); from += kittyChunk) {
        text += "\033_G";
        if (from == 0) text += "a=T,f=100,";
        text += fmt::format("m={};{}\033\\", from + kittyChunk < data.size() ? 1 : 0, data.substr(from, kittyChunk));
    }
    return text + '\n';
}

std::string sixelText(const ShownPicture& picture) {
    std::string text = fmt::format("\033Pq\"1;1;{};{}", picture.width, picture.height);
    for (unsigned colour = 0; colour < channelLevels * channelLevels * channelLevels; ++colour) {
        const auto percent = [](unsigned level) { return 100 * (level % channelLevels) / (channelLevels - 1); };
        text += fmt::format("#{};2;{};{};{}", colour, percent(colour / channelLevels / channelLevels),
                            percent(colour / channelLevels), percent(colour));
    }
    for (unsigned top = 0; top < picture.height; top += sixelRows) appendBand(text, picture, top);
    return text + "\033\\\n";
}

ShownPicture smallPicture(const FilmImage& image, const ExposureChoice& exposure, unsigned longest) {
    const unsigned step = (std::max(image.width, image.height) + longest - 1) / longest;
    FilmImage small;
    small.width = image.width / step;
    small.height = image.height / step;
    if (small.width == 0 || small.height == 0) return {};
    small.radiance.resize(size_t(small.width) * small.height * 3);
    const float weight = 1.f / static_cast<float>(step * step);
    for (unsigned y = 0; y < small.height * step; ++y)
        for (unsigned x = 0; x < small.width * step; ++x)
            for (size_t c = 0; c < 3; ++c)
                small.radiance[3 * (size_t(y / step) * small.width + x / step) + c] +=
                    weight * image.radiance[3 * (size_t(y) * image.width + x) + c];
    return {small.width, small.height, toneMap(small, chooseToneCurve(image, exposure))};
}

std::optional<std::string> showImage(const std::string& how, const FilmImage& image, const ExposureChoice& exposure) {
    if (isatty(STDOUT_FILENO) != 1) return "--show: stdout is no terminal, so that no picture is shown";
    const ShownPicture picture = smallPicture(image, exposure, longestShown);
    if (picture.pixels.empty()) return std::nullopt; // such as one line of a meter
    fmt::print("{}", how == "kitty" ? kittyText(picture) : sixelText(picture));
    std::fflush(stdout);
    return std::nullopt;
}

} // namespace quasilux
