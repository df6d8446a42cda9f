// Layers, header and rows of the OpenEXR file, by OpenImageIO.
#include "output/exr.h"

#include "output/image_writer.h"
#include "output/meter_reading.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

struct Layer {
    std::vector<std::string> channels; ///< names, such as "direct.R"
    const std::vector<float>* values;  ///< pixel by pixel, one for each channel
};

Layer colors(const std::string& prefix, const std::vector<float>& rgb) {
    return {{prefix + "R", prefix + "G", prefix + "B"}, &rgb};
}

/// Of each pixel the products of `rows` with its colour.
std::vector<float> combined(const std::vector<std::array<float, 3>>& rows, const std::vector<float>& rgb) {
    std::vector<float> values;
    values.reserve(rgb.size() / 3 * rows.size());
    for (size_t at = 0; at + 2 < rgb.size(); at += 3)
        for (const auto& row : rows) values.push_back(row[0] * rgb[at] + row[1] * rgb[at + 1] + row[2] * rgb[at + 2]);
    return values;
}

/// Linear sRGB (Rec. 709 primaries, D65) to CIE XYZ, by rows.
const std::vector<std::array<float, 3>> xyzOfRgb = {
    {0.412453f, 0.357580f, 0.180423f}, {0.212671f, 0.715160f, 0.072169f}, {0.019334f, 0.119193f, 0.950227f}};

/// In other terms than R, G, B, as the film's pixel_format asks; empty where it does not.
struct OtherTerms {
    OtherTerms(const FilmImage& image, const PixelFormat& format) {
        if (format.luminance) luminance = combined({xyzOfRgb[1]}, image.radiance);
        if (format.xyz) xyz = combined(xyzOfRgb, image.radiance);
    }
    std::vector<float> luminance, xyz;
};

std::vector<Layer> layersOf(const FilmImage& image, const OtherTerms& terms, const std::vector<AovImage>& aovs) {
    std::vector<Layer> layers{colors("", image.radiance)};
    if (!terms.luminance.empty()) layers.push_back({{"Y"}, &terms.luminance});
    if (!terms.xyz.empty()) layers.push_back({{"X", "Y", "Z"}, &terms.xyz});
    for (unsigned i = 0; i < FILM_COMPONENTS; ++i)
        if (const auto& values = image.components[i].radiance; !values.empty())
            layers.push_back(colors(componentName(i) + ".", values));
    if (image.isErrorKnown()) layers.push_back(colors("stderr.", image.standardError));
    if (!image.bias.empty()) {
        layers.push_back(colors("bias.", image.bias));
        layers.push_back(colors("bias_stderr.", image.biasError));
    }
    for (const auto& aov : aovs) layers.push_back({aov.channels, &aov.values});

    const size_t pixels = size_t{image.width} * image.height;
    for (const auto& layer : layers)
        if (const size_t expected = pixels * layer.channels.size(); expected == 0 || layer.values->size() != expected)
            throw std::runtime_error("layer '" + layer.channels[0] + "' of the image has " +
                                     std::to_string(layer.values->size()) + " values, expected " +
                                     std::to_string(expected));
    return layers;
}

size_t channelsOf(const std::vector<Layer>& layers) {
    size_t count = 0;
    for (const auto& layer : layers) count += layer.channels.size();
    return count;
}

/// Keys `quasilux:noiseMean` … of the whole image, `quasilux:diffuse.noiseMean` … of its components.
void describeError(OIIO::ImageSpec& spec, const ErrorEstimate& error) {
    if (!error.isKnown()) return; // after one pass nothing is known
    const auto real = [&](const std::string& key, double value) {
        spec.attribute("quasilux:" + key, static_cast<float>(value));
    };
    const auto part = [&](const std::string& prefix, const ErrorPart& values) {
        real(prefix + "noiseMean", values.noiseMean);
        real(prefix + "noisePercentile95", values.noisePercentile95);
        real(prefix + "noiseRms", values.noiseRms);
        if (!error.hasBias) return;
        real(prefix + "biasRms", values.biasRms);
        real(prefix + "biasNoiseRms", values.biasNoiseRms);
    };
    real("relativeError", error.sum());
    part("", error.total);
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
        if (error.components[c].noiseRms > 0) part(componentName(c) + '.', error.components[c]);
}

void describe(OIIO::ImageSpec& spec, const RenderRecord& record) {
    const RenderSettings& settings = record.settings;
    const auto set = [&](const char* key, const auto& value) {
        using Value = std::decay_t<decltype(value)>;
        const std::string attribute = std::string("quasilux:") + key;
        if constexpr (std::is_same_v<Value, uint64_t>) // a header holds no whole number that large
            spec.attribute(attribute, std::to_string(value));
        else if constexpr (std::is_same_v<Value, unsigned>)
            spec.attribute(attribute, static_cast<int>(std::min<unsigned>(value, INT32_MAX)));
        else if constexpr (std::is_floating_point_v<Value>)
            spec.attribute(attribute, static_cast<float>(value));
        else
            spec.attribute(attribute, std::string(value));
    };
    spec.attribute("Software", "quasilux " + record.version);
    set("version", record.version);
    record.forEachSetting(set);
    set("kernels", settings.genericKernels ? "generic" : "scene");
    set("quantity", quantityName(record.meter));
    set("units", record.units());
    if (record.view) {
        set("projection", record.view->projection);
        set("fov", record.view->degrees);
    }
    describeError(spec, record.error);
}

/// Interleaves the layers a few rows at a time: with all layers at once a large image would take gigabytes.
bool writeRows(OIIO::ImageOutput& output, const FilmImage& image, const std::vector<Layer>& layers) {
    constexpr unsigned rowsAtOnce = 64; // a multiple of the 16 rows that zip packs together
    const size_t channels = channelsOf(layers);
    for (unsigned first = 0; first < image.height; first += rowsAtOnce) {
        const unsigned end = std::min(first + rowsAtOnce, image.height);
        const size_t firstPixel = size_t{first} * image.width, pixels = size_t{end - first} * image.width;
        std::vector<float> rows(pixels * channels);
        size_t channel = 0;
        for (const auto& layer : layers) {
            const size_t width = layer.channels.size();
            for (size_t i = 0; i < pixels; ++i)
                std::copy_n(&(*layer.values)[width * (firstPixel + i)], width, &rows[i * channels + channel]);
            channel += width;
        }
        if (!output.write_scanlines(static_cast<int>(first), static_cast<int>(end), 0, OIIO::TypeDesc::FLOAT,
                                    rows.data()))
            return false;
    }
    return true;
}

} // namespace

void writeExr(const std::string& path, const FilmImage& image, const RenderRecord& record,
              const std::vector<AovImage>& aovs) {
    const OtherTerms terms(image, record.pixelFormat);
    const auto layers = layersOf(image, terms, aovs);
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                         static_cast<int>(channelsOf(layers)), OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (const auto& layer : layers)
        spec.channelnames.insert(spec.channelnames.end(), layer.channels.begin(), layer.channels.end());
    spec.attribute("compression", "zip");
    describe(spec, record);

    writeImage(path, "openexr", spec, [&](OIIO::ImageOutput& output) { return writeRows(output, image, layers); });
}

} // namespace quasilux
