// Channels by name, and what is refused.
#include "compare/image_file.h"

#include "util/error.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

struct Pixels {
    OIIO::ImageSpec spec;
    std::vector<float> values; ///< width*height*nchannels

    int channel(const std::string& name) const {
        const auto& names = spec.channelnames;
        const auto found = std::find(names.begin(), names.end(), name);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    }
    /// Three channels interleaved.
    std::vector<float> select(const std::vector<int>& channels) const {
        const auto stride = static_cast<size_t>(spec.nchannels);
        std::vector<float> rgb;
        rgb.reserve(values.size() / stride * 3);
        for (size_t first = 0; first < values.size(); first += stride)
            for (const int c : channels) rgb.push_back(values[first + static_cast<size_t>(c)]);
        return rgb;
    }
};

/// Size and formats are looked at before any pixel is read.
void checkFormat(const std::string& path, const OIIO::ImageSpec& spec) {
    if (spec.deep) throw InputError(path + ": is a deep image, expected a flat one");
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
        throw InputError(fmt::format("{}: has {} x {} x {} pixels of {} channels, expected a picture", path, spec.width,
                                     spec.height, spec.depth, spec.nchannels));
    if (!spec.format.is_floating_point())
        throw InputError(fmt::format("{}: pixels are {}, which hold encoded colours; expected linear radiance in "
                                     "floating point, such as EXR, PFM or HDR",
                                     path, spec.format.c_str()));
}

Pixels readPixels(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    if (!input) throw InputError(fmt::format("{}: cannot read the image: {}", path, OIIO::geterror()));
    Pixels pixels{input->spec(), {}};
    const OIIO::ImageSpec& spec = pixels.spec;
    checkFormat(path, spec);
    pixels.values.resize(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.values.data()))
        throw InputError(fmt::format("{}: cannot read the pixels: {}", path, input->geterror()));
    return pixels;
}

/// Places of R, G, B, or three times that of the only channel of a grey image.
std::vector<int> colourChannels(const std::string& path, const Pixels& pixels) {
    std::vector<int> rgb{pixels.channel("R"), pixels.channel("G"), pixels.channel("B")};
    if (std::find(rgb.begin(), rgb.end(), -1) == rgb.end()) return rgb;
    const int grey = pixels.spec.nchannels == 1 ? 0 : pixels.channel("Y");
    if (grey >= 0 && rgb == std::vector<int>(3, -1)) return {grey, grey, grey};
    throw InputError(fmt::format("{}: expected channels R, G and B, or one channel; found {}", path,
                                 fmt::join(pixels.spec.channelnames, ", ")));
}

size_t countUnusable(const std::vector<float>& standardError) {
    return static_cast<size_t>(std::count_if(standardError.begin(), standardError.end(),
                                             [](float e) { return !(std::isfinite(e) && e >= 0); }));
}

std::string sizeText(const RadianceImage& image) { return fmt::format("{} x {}", image.width, image.height); }

} // namespace

RadianceImage readRadiance(const std::string& path) {
    const Pixels pixels = readPixels(path);
    RadianceImage image;
    image.path = path;
    image.width = static_cast<unsigned>(pixels.spec.width);
    image.height = static_cast<unsigned>(pixels.spec.height);
    image.radiance = pixels.select(colourChannels(path, pixels));
    const std::vector<int> errors{pixels.channel("stderr.R"), pixels.channel("stderr.G"), pixels.channel("stderr.B")};
    if (std::find(errors.begin(), errors.end(), -1) == errors.end()) {
        image.standardError = pixels.select(errors);
        dropUnusableErrors(image);
    }
    return image;
}

void dropUnusableErrors(RadianceImage& image) {
    const size_t unusable = countUnusable(image.standardError);
    if (unusable == 0) return;
    image.warning = fmt::format("{}: {} values of the stderr layers are negative or not finite, the noise of "
                                "this image counts as unknown",
                                image.path, unusable);
    image.standardError.clear();
}

std::vector<float> readStandardError(const std::string& path, const RadianceImage& image, const std::string& option) {
    const RadianceImage errors = readRadiance(path);
    if (errors.width != image.width || errors.height != image.height)
        throw InputError(fmt::format("{} {}: has {} pixels, expected {} as {}", option, path, sizeText(errors),
                                     sizeText(image), image.path));
    if (const size_t unusable = countUnusable(errors.radiance))
        throw InputError(fmt::format("{} {}: {} values are negative or not finite, expected standard errors", option,
                                     path, unusable));
    return errors.radiance;
}

void requireEqualSizes(const RadianceImage& image, const RadianceImage& reference) {
    if (image.width != reference.width || image.height != reference.height)
        throw InputError(fmt::format("{} has {} pixels but {} has {}; expected images of the same view and size",
                                     image.path, sizeText(image), reference.path, sizeText(reference)));
}

} // namespace quasilux
