// Layers, header and rows of the OpenEXR file, by OpenImageIO.
#include "output/exr.h"

#include "output/atomic_file.h"
#include "output/meter_reading.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

struct Layer {
    std::string prefix; ///< of the channel names, such as "direct."
    const std::vector<float>* rgb;
};

std::vector<Layer> layersOf(const FilmImage& image) {
    std::vector<Layer> layers{{"", &image.radiance}};
    for (unsigned i = 0; i < FILM_COMPONENTS; ++i)
        if (!image.components[i].empty()) layers.push_back({componentName(i) + ".", &image.components[i]});
    if (!image.standardError.empty()) layers.push_back({"stderr.", &image.standardError});
    if (!image.bias.empty()) {
        layers.push_back({"bias.", &image.bias});
        layers.push_back({"bias_stderr.", &image.biasError});
    }

    const size_t expected = size_t{image.width} * image.height * 3;
    for (const auto& layer : layers)
        if (expected == 0 || layer.rgb->size() != expected)
            throw std::runtime_error("layer '" + layer.prefix + "' of the image has " +
                                     std::to_string(layer.rgb->size()) + " values, expected " +
                                     std::to_string(expected));
    return layers;
}

/// Keys `quasilux:noiseMean` … of the whole image, `quasilux:diffuse.noiseMean` … of its components.
void describeError(OIIO::ImageSpec& spec, const ErrorEstimate& error) {
    if (!std::isfinite(error.sum())) return; // after one pass nothing is known
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
    if (record.meter != MeterKind::none) set("units", settings.photometric ? "photometric" : "radiometric");
    describeError(spec, record.error);
}

/// Interleaves the layers a few rows at a time: with all layers at once a large image would take gigabytes.
bool writeRows(OIIO::ImageOutput& output, const FilmImage& image, const std::vector<Layer>& layers) {
    constexpr unsigned rowsAtOnce = 64; // a multiple of the 16 rows that zip packs together
    const size_t channels = 3 * layers.size();
    for (unsigned first = 0; first < image.height; first += rowsAtOnce) {
        const unsigned end = std::min(first + rowsAtOnce, image.height);
        const size_t firstPixel = size_t{first} * image.width, pixels = size_t{end - first} * image.width;
        std::vector<float> rows(pixels * channels);
        for (size_t l = 0; l < layers.size(); ++l)
            for (size_t i = 0; i < pixels; ++i)
                std::copy_n(&(*layers[l].rgb)[3 * (firstPixel + i)], 3, &rows[i * channels + 3 * l]);
        if (!output.write_scanlines(static_cast<int>(first), static_cast<int>(end), 0, OIIO::TypeDesc::FLOAT,
                                    rows.data()))
            return false;
    }
    return true;
}

} // namespace

void writeExr(const std::string& path, const FilmImage& image, const RenderRecord& record) {
    const auto layers = layersOf(image);
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                         static_cast<int>(3 * layers.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (const auto& layer : layers)
        for (const char* channel : {"R", "G", "B"}) spec.channelnames.push_back(layer.prefix + channel);
    spec.attribute("compression", "zip");
    describe(spec, record);

    AtomicFile file(path);
    const auto output = OIIO::ImageOutput::create("openexr"); // by format: the temporary name ends in .tmp
    if (!output) throw std::runtime_error("cannot write " + path + ": " + OIIO::geterror());
    if (!output->open(file.temporary(), spec) || !writeRows(*output, image, layers) || !output->close())
        throw std::runtime_error("cannot write " + path + ": " + output->geterror());
    file.commit();
}

} // namespace quasilux
