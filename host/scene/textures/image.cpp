// Image files for textures, by OpenImageIO.
#include "images/image_rows.h"
#include "images/radiance_header.h"
#include "scene/color.h"
#include "scene/textures/image_primaries.h"
#include "scene/textures/texture_plugin.h"
#include "scene/xml/names.h"
#include "scene/xml/xml_document.h"
#include "util/file_ending.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

namespace quasilux {

namespace {

[[noreturn]] void failImage(const std::string& path, const std::string& why, const SourceLocation& where) {
    throw InputError(where, fmt::format("cannot read the image '{}': {}", path, why));
}

// What values of pixels may be.
struct Range {
    float least, most;  // beyond them a value is moved to the nearest one
    bool mayBeNegative; // or else that is an error
    const char* rule;
};
constexpr Range reflectances{0, 1, false, "reflectances lie within [0, 1]"};
constexpr float largest = std::numeric_limits<float>::max();
constexpr Range positive{0, largest, true, "expected a finite number"};
constexpr Range heights{-largest, largest, true, "expected a finite number"};

const Range& rangeOf(TextureUse use) {
    if (use == TextureUse::height) return heights;
    return use == TextureUse::reflectance ? reflectances : positive;
}

// Formats that name no further files, by the ending: others of OpenImageIO's readers play films, for example.
constexpr std::pair<std::string_view, const char*> plainFormats[] = {
    {".exr", "openexr"}, {".hdr", "hdr"}, {".png", "png"},   {".jpg", "jpeg"}, {".jpeg", "jpeg"}, {".tif", "tiff"},
    {".tiff", "tiff"},   {".bmp", "bmp"}, {".tga", "targa"}, {".pfm", "pnm"},  {".ppm", "pnm"},   {".pgm", "pnm"}};

/// By the reader of a format, or of an ending without the dot; null where there is none.
std::unique_ptr<OIIO::ImageInput> readerOf(const std::string& format, OIIO::Filesystem::IOProxy& content) {
    auto reader = OIIO::ImageInput::create(format);
    OIIO::geterror(); // or it would be taken for that of the next one
    return reader && reader->set_ioproxy(&content) ? std::move(reader) : nullptr;
}

std::unique_ptr<OIIO::ImageInput> openPlain(const std::string& path, const OIIO::ImageSpec& wish,
                                            OIIO::Filesystem::IOProxy& content, const SourceLocation& where) {
    for (const auto& [known, format] : plainFormats) {
        if (fileEnding(path) != known) continue;
        auto file = readerOf(format, content);
        OIIO::ImageSpec spec;
        if (!file) failImage(path, fmt::format("OpenImageIO was built without the format {}.", format), where);
        if (!file->open(path, spec, wish)) failImage(path, file->geterror(), where);
        return file;
    }
    Names endings;
    for (const auto& [known, format] : plainFormats) endings.push_back(known);
    failImage(path,
              fmt::format("scenes that are not trusted may have images with these endings: {}.", joinNames(endings)),
              where);
}

/// Files that are called what they are not, and those of a few rare formats, OpenImageIO opens itself.
std::unique_ptr<OIIO::ImageInput> openAny(const std::string& path, const OIIO::ImageSpec& wish,
                                          OIIO::Filesystem::IOProxy& content, const SourceLocation& where) {
    const std::string ending = fileEnding(path);
    auto file = ending.size() > 1 ? readerOf(ending.substr(1), content) : nullptr;
    OIIO::ImageSpec spec;
    if (file && file->open(path, spec, wish)) return file;
    file = OIIO::ImageInput::open(path, &wish);
    if (!file) failImage(path, OIIO::geterror(), where);
    return file;
}

/// Values as the file has them, of up to three channels.
struct StoredPixels {
    OIIO::ImageSpec spec;
    unsigned width = 0, height = 0;
    int channels = 0;
    std::vector<float> values;
};

/// From memory: OpenImageIO overlooks some bytes that it cannot read, such as those at the end of a PNG.
StoredPixels readStored(const std::string& path, const SourceLocation& where, LoadGuard& guard) {
    std::string content = readFile(path, where, "image");
    OIIO::Filesystem::IOMemReader memory(content.data(), content.size());
    OIIO::ImageSpec asStored;
    asStored["oiio:UnassociatedAlpha"] = 1; // colours are not to be multiplied by an alpha that is left out
    const auto file = (guard.isTrusted() ? openAny : openPlain)(path, asStored, memory, where);
    StoredPixels stored;
    const OIIO::ImageSpec& spec = stored.spec = file->spec();
    if (const std::string fault = faultOfSize(spec); !fault.empty()) failImage(path, fault, where);
    guard.addPixels(spec.image_pixels(), where);
    stored.width = static_cast<unsigned>(spec.width);
    stored.height = static_cast<unsigned>(spec.height);
    stored.channels = std::min(spec.nchannels, 3);
    if (const std::string fault = readRows(*file, stored.channels, stored.values); !fault.empty())
        failImage(path, fault, where);
    if (file->format_name() == std::string_view("hdr"))
        turnUpright(radianceHeader(content), stored.width, stored.height, stored.values);
    return stored;
}

/// Decodes sRGB. Of files of bytes there are 256 values, which are decoded once: powers are most of the time that a
/// large image takes.
class Decoder {
public:
    explicit Decoder(bool ofBytes) : ofBytes_(ofBytes) { known_.fill(-1); }

    float operator()(float value) {
        if (!ofBytes_ || !(value >= 0 && value <= 1)) return decodeSrgb(value);
        float& known = known_[static_cast<size_t>(std::lround(255 * value))];
        if (known < 0) known = decodeSrgb(value);
        return known;
    }

private:
    bool ofBytes_;
    std::array<float, 256> known_{};
};

} // namespace

Image readImage(const std::string& path, bool raw, TextureUse use, const SourceLocation& where, LoadGuard& guard) {
    const Range& range = rangeOf(use);
    const auto [spec, width, height, channels, values] = readStored(path, where, guard);
    const bool encoded = !raw && !spec.format.is_floating_point();
    const std::optional<glm::dmat3> toSrgb = toLinearSrgb(spec);
    Decoder decode(spec.format == OIIO::TypeDesc::UINT8);
    const auto step = static_cast<size_t>(channels);
    const size_t green = channels < 3 ? 0 : 1, blue = channels < 3 ? 0 : 2; // one channel, or grey and alpha
    Image image{width, height, {}, 0};
    std::vector<Rgb> pixels;
    pixels.reserve(values.size() / step);
    for (size_t i = 0; i < values.size(); i += step) {
        glm::vec3 pixel(values[i], values[i + green], values[i + blue]);
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(pixel[c]) || (pixel[c] < 0 && !range.mayBeNegative))
                failImage(path,
                          fmt::format("pixel {}, {} has the value {}; {}.", i / step % image.width,
                                      i / step / image.width, pixel[c], range.rule),
                          where);
            if (encoded) pixel[c] = decode(pixel[c]);
        }
        if (toSrgb) pixel = glm::vec3(*toSrgb * glm::dvec3(pixel));
        const glm::vec3 within = glm::clamp(pixel, range.least, range.most);
        image.clamped += within != pixel;
        pixels.push_back({within.x, within.y, within.z});
    }
    image.pixels = std::move(pixels);
    return image;
}

} // namespace quasilux
