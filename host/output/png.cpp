// Automatic exposure, tone curve and sRGB encoding of the PNG.
#include "output/png.h"

#include "output/image_writer.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace quasilux {

namespace {

double luminance(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

/// Nearest-rank percentile; reorders `values`, which must not be empty.
double percentile(std::vector<double>& values, double share) {
    const auto count = static_cast<double>(values.size());
    const auto rank = static_cast<std::ptrdiff_t>(std::max(std::ceil(share * count), 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<size_t>(rank)];
}

/// IEC 61966-2-1.
uint8_t encodeSrgb(double linear) {
    const double clamped = std::clamp(linear, 0.0, 1.0);
    const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255 * encoded));
}

} // namespace

ToneCurve chooseToneCurve(const FilmImage& image, const ExposureChoice& choice) {
    if (choice.scale) return {*choice.scale, 1};
    std::vector<double> lit;
    for (size_t i = 0; i + 2 < image.radiance.size(); i += 3) {
        const double value = luminance(&image.radiance[i]);
        if (value > 0 && std::isfinite(value)) lit.push_back(value);
    }
    if (lit.empty()) return {std::exp2(choice.stops.value_or(0)), 1};
    const double scale = 0.8 / percentile(lit, 0.9) * std::exp2(choice.stops.value_or(0));
    return {scale, std::max(1.0, scale * percentile(lit, 0.999))};
}

std::vector<uint8_t> toneMap(const FilmImage& image, const ToneCurve& curve) {
    std::vector<uint8_t> pixels(image.radiance.size());
    for (size_t i = 0; i + 2 < pixels.size(); i += 3) {
        const double x = curve.scale * std::max(luminance(&image.radiance[i]), 0.0);
        const double compression = (1 + x / (curve.white * curve.white)) / (1 + x);
        for (size_t c = 0; c < 3; ++c) pixels[i + c] = encodeSrgb(curve.scale * compression * image.radiance[i + c]);
    }
    return pixels;
}

void writePng(const std::string& path, const FilmImage& image, const ToneCurve& curve, const RenderRecord& record) {
    const auto pixels = toneMap(image, curve);
    if (pixels.empty() || pixels.size() != size_t{image.width} * image.height * 3)
        throw std::runtime_error("cannot write " + path + ": the image has no pixels or not as many as its size says");
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", "quasilux " + record.version);
    // PNG headers hold text only.
    spec.attribute("quasilux:scene", record.scene);
    spec.attribute("quasilux:passes", std::to_string(record.counters.passes));
    spec.attribute("quasilux:seed", std::to_string(record.settings.seed));
    spec.attribute("quasilux:exposureScale", fmt::format("{:.9g}", curve.scale));
    spec.attribute("quasilux:exposureWhite", fmt::format("{:.9g}", curve.white));

    writeImage(path, "png", spec,
               [&](OIIO::ImageOutput& output) { return output.write_image(OIIO::TypeDesc::UINT8, pixels.data()); });
}

} // namespace quasilux
