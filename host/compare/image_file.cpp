// Channels by name, and what is refused.
#include "compare/image_file.h"

#include "images/image_rows.h"
#include "images/radiance_header.h"
#include "util/error.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <string_view>

namespace quasilux {

namespace {

/// -1: there is none.
int channelOf(const OIIO::ImageSpec& spec, const std::string& name) {
    const auto& names = spec.channelnames;
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

/// Appends three of `stride` interleaved channels.
void append(const float* values, size_t count, size_t stride, const std::vector<int>& channels,
            std::vector<float>& rgb) {
    for (size_t first = 0; first < count; first += stride)
        for (const int c : channels) rgb.push_back(values[first + static_cast<size_t>(c)]);
}

/// Size and formats are looked at before any pixel is read.
void checkFormat(const std::string& path, const OIIO::ImageSpec& spec) {
    if (spec.deep) throw InputError(path + ": is a deep image, expected a flat one");
    if (const std::string fault = faultOfSize(spec); !fault.empty())
        throw InputError(fmt::format("{}: cannot read the image: {}", path, fault));
    if (!spec.format.is_floating_point())
        throw InputError(fmt::format("{}: pixels are {}, which hold encoded colours; expected linear radiance in "
                                     "floating point, such as EXR, PFM or HDR",
                                     path, spec.format.c_str()));
}

/// Places of R, G, B, or three times that of the only channel of a grey image.
std::vector<int> colourChannels(const std::string& path, const OIIO::ImageSpec& spec) {
    std::vector<int> rgb{channelOf(spec, "R"), channelOf(spec, "G"), channelOf(spec, "B")};
    if (std::find(rgb.begin(), rgb.end(), -1) == rgb.end()) return rgb;
    const int grey = spec.nchannels == 1 ? 0 : channelOf(spec, "Y");
    if (grey >= 0 && rgb == std::vector<int>(3, -1)) return {grey, grey, grey};
    throw InputError(fmt::format("{}: expected channels R, G and B, or one channel; found {}", path,
                                 fmt::join(spec.channelnames, ", ")));
}

/// Of standard errors; empty where not all are there.
std::vector<int> errorChannels(const OIIO::ImageSpec& spec) {
    const std::vector<int> rgb{channelOf(spec, "stderr.R"), channelOf(spec, "stderr.G"), channelOf(spec, "stderr.B")};
    return std::find(rgb.begin(), rgb.end(), -1) == rgb.end() ? rgb : std::vector<int>();
}

/// What OpenImageIO leaves to be done of a Radiance picture.
void applyRadianceHeader(RadianceImage& image) {
    constexpr size_t mostBytes = 1 << 16;
    std::string head(mostBytes, '\0');
    std::ifstream file(image.path, std::ios::binary);
    file.read(head.data(), mostBytes);
    head.resize(static_cast<size_t>(file.gcount()));
    const RadianceHeader header = radianceHeader(head);
    if (!(header.exposure > 0 && std::isfinite(header.exposure)))
        throw InputError(image.path + ": EXPOSURE in its header is no positive number; mend it, or leave it out where "
                                      "pixels are radiance");
    for (float& value : image.radiance) value = static_cast<float>(value / header.exposure);
    turnUpright(header, image.width, image.height, image.radiance);
}

size_t countUnusable(const std::vector<float>& standardError) {
    return static_cast<size_t>(std::count_if(standardError.begin(), standardError.end(),
                                             [](float e) { return !(std::isfinite(e) && e >= 0); }));
}

std::string sizeText(const RadianceImage& image) { return fmt::format("{} x {}", image.width, image.height); }

} // namespace

RadianceImage readRadiance(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    if (!input) throw InputError(fmt::format("{}: cannot read the image: {}", path, OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    checkFormat(path, spec);
    RadianceImage image;
    image.path = path;
    image.width = static_cast<unsigned>(spec.width);
    image.height = static_cast<unsigned>(spec.height);
    const std::vector<int> colours = colourChannels(path, spec), errors = errorChannels(spec);
    const auto stride = static_cast<size_t>(spec.nchannels);
    const std::string fault = readRows(*input, spec.nchannels, [&](const float* values, size_t count) {
        if (image.radiance.empty()) {
            image.radiance.reserve(3 * image.pixels());
            if (!errors.empty()) image.standardError.reserve(3 * image.pixels());
        }
        append(values, count, stride, colours, image.radiance);
        append(values, count, stride, errors, image.standardError);
    });
    if (!fault.empty()) throw InputError(fmt::format("{}: cannot read the pixels: {}", path, fault));
    if (input->format_name() == std::string_view("hdr")) applyRadianceHeader(image);
    dropUnusableErrors(image);
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
