// Colour scales, shared exponents, PNG in memory, base64 (RFC 4648).
#include "compare/error_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

uint8_t toByte(double share) { return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))); }

/// -1 blue, 0 white, 1 red.
void addSigned(Picture& picture, double value) {
    if (std::isnan(value)) {
        picture.insert(picture.end(), nonFiniteColour.begin(), nonFiniteColour.end());
        return;
    }
    const double strength = std::min(std::abs(value), 1.0);
    const uint8_t faded = toByte(1 - strength);
    if (value >= 0)
        picture.insert(picture.end(), {toByte(1 - 0.2 * strength), faded, faded});
    else
        picture.insert(picture.end(), {faded, faded, toByte(1 - 0.2 * strength)});
}

void addHeat(Picture& picture, double share) {
    picture.insert(picture.end(), {toByte(3 * share), toByte(3 * share - 1), toByte(3 * share - 2)});
}

double signedSquareRoot(double difference, double scale) { return difference == 0 ? 0 : difference / std::sqrt(scale); }

std::string base64(const std::vector<unsigned char>& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = std::min<size_t>(bytes.size() - i, 3);
        const unsigned group = bytes[i] << 16u | (left > 1 ? bytes[i + 1] << 8u : 0u) | (left > 2 ? bytes[i + 2] : 0u);
        for (size_t k = 0; k < 4; ++k) text += k <= left ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

} // namespace

Picture signedPicture(const RadianceImage& image, const RadianceImage& reference) {
    double sum = 0;
    size_t count = 0;
    for (const float value : reference.radiance)
        if (std::isfinite(value)) {
            sum += value;
            ++count;
        }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
    Picture picture;
    for (size_t i = 0; i < image.radiance.size(); i += 3) {
        const double r = luminance(&reference.radiance[i]), difference = luminance(&image.radiance[i]) - r;
        addSigned(picture, std::isfinite(difference)
                               ? signedSquareRoot(difference, r * r + 0.01 * mean * mean) / signedScale
                               : std::nan(""));
    }
    return picture;
}

Picture squarePicture(const Comparison& comparison) {
    Picture picture;
    for (const double value : comparison.relativeSquares)
        if (std::isinf(value))
            picture.insert(picture.end(), nonFiniteColour.begin(), nonFiniteColour.end());
        else
            addHeat(picture, std::log(std::max(value, squareScaleFrom) / squareScaleFrom) /
                                 std::log(squareScaleTo / squareScaleFrom));
    return picture;
}

Picture standardErrorPicture(const RadianceImage& image, const RadianceImage& reference) {
    if (image.standardError.empty() && reference.standardError.empty()) return {};
    Picture picture;
    for (size_t i = 0; i < image.radiance.size(); i += 3) {
        // Channels of a pixel come from the same paths, so their errors add up as they are, not as squares.
        double variance = 0;
        for (const RadianceImage* side : {&image, &reference})
            if (!side->standardError.empty()) variance += std::pow(luminance(&side->standardError[i]), 2);
        const double difference = luminance(&image.radiance[i]) - luminance(&reference.radiance[i]);
        addSigned(picture, difference == 0 ? 0 : difference / std::sqrt(variance) / standardErrorScale);
    }
    return picture;
}

Picture sharedExponentPicture(const RadianceImage& image) {
    Picture picture(2 * image.radiance.size());
    for (size_t i = 0; i < image.radiance.size(); i += 3) {
        const float* rgb = &image.radiance[i];
        uint8_t* const exponents = &picture[image.radiance.size() + i];
        if (!(std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]))) {
            std::fill_n(exponents, 3, uint8_t{255});
            continue;
        }
        int exponent = 0; // the largest value is in [1/2, 1) * 2^exponent
        const float largest = std::max({rgb[0], rgb[1], rgb[2]});
        if (!(largest > 0) || (std::frexp(largest, &exponent), exponent < -127)) continue;
        exponent = std::min(exponent, 126);
        for (size_t c = 0; c < 3; ++c) picture[i + c] = toByte(std::ldexp(std::max(rgb[c], 0.0f), 8 - exponent) / 255);
        std::fill_n(exponents, 3, static_cast<uint8_t>(exponent + 128));
    }
    return picture;
}

std::vector<unsigned char> pngBytes(const Picture& picture, unsigned width, unsigned height) {
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png", &memory);
    if (!output || !output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.data()) ||
        !output->close())
        throw std::runtime_error("cannot make a PNG: " + (output ? output->geterror() : OIIO::geterror()));
    return bytes;
}

std::string pngDataUri(const Picture& picture, unsigned width, unsigned height) {
    return "data:image/png;base64," + base64(pngBytes(picture, width, height));
}

} // namespace quasilux
