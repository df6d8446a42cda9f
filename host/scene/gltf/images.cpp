#include "scene/gltf/images.h"

#include "images/image_rows.h"
#include "scene/color.h"
#include "scene/gltf/accessors.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr int64_t maximumPixels = 1 << 26;

struct Encoded {
    const unsigned char* data = nullptr;
    size_t size = 0;
};

Encoded encodedImage(const GltfContext& context, const tinygltf::Image& image, const SourceLocation& where) {
    if (image.bufferView < 0) return {image.image.data(), image.image.size()};
    const GltfBytes bytes = bytesOfView(context, image.bufferView, where);
    return {bytes.data, bytes.size};
}

/// By the first bytes: what the file says of its kind, or is called, is often wrong.
const char* formatOf(const Encoded& bytes, const SourceLocation& where) {
    const auto begins = [&](std::string_view mark) {
        return bytes.size >= mark.size() &&
               std::equal(mark.begin(), mark.end(), bytes.data,
                          [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
    };
    if (begins("\x89PNG")) return "png";
    if (begins("\xff\xd8\xff")) return "jpeg";
    throw InputError(where, fmt::format("the image of {} bytes is neither PNG nor JPEG.", bytes.size));
}

/// Red, green, blue and alpha of the channels that there are: grey, grey and alpha, colour, colour and alpha.
glm::vec4 fromChannels(const float* values, int channels) {
    const bool isGrey = channels < 3;
    const float alpha = channels == 2 ? values[1] : channels >= 4 ? values[3] : 1.0f;
    return {values[0], values[isGrey ? 0 : 1], values[isGrey ? 0 : 2], alpha};
}

} // namespace

const GltfImages::Pixels& GltfImages::pixelsOf(int index) {
    if (index == lastIndex_) return last_;
    const SourceLocation where = context_.at("images", static_cast<size_t>(index));
    const Encoded bytes = encodedImage(context_, context_.model.images[static_cast<size_t>(index)], where);
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data), bytes.size);
    const std::string format = formatOf(bytes, where);
    OIIO::ImageSpec wish;
    wish["oiio:UnassociatedAlpha"] = 1;
    const auto fail = [&](const std::string& why) {
        throw InputError(where, fmt::format("cannot read the image: {}", why));
    };
    const auto file = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (!file || !file->set_ioproxy(&memory)) fail("OpenImageIO was built without this format.");
    if (!file->open("image." + format, spec, wish)) fail(file->geterror());
    const int64_t count = int64_t(spec.width) * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || count > maximumPixels)
        fail(fmt::format("it has {} x {} pixels of {} channels; expected at most {} pixels.", spec.width, spec.height,
                         spec.nchannels, maximumPixels));
    context_.files.guard().addPixels(static_cast<uint64_t>(count), where);
    const int channels = std::min(spec.nchannels, 4);
    std::vector<float> values;
    if (const std::string fault = readRows(*file, channels, values); !fault.empty()) fail(fault);
    last_ = {static_cast<unsigned>(spec.width), static_cast<unsigned>(spec.height), {}};
    last_.values.reserve(static_cast<size_t>(count));
    for (size_t i = 0; i < values.size(); i += static_cast<size_t>(channels))
        last_.values.push_back(fromChannels(&values[i], channels));
    lastIndex_ = index;
    return last_;
}

MadeImage GltfImages::make(int index, PixelCode code, const std::string& meaning, const PixelChange& change) {
    const std::string name = fmt::format("images[{}] {}", index, meaning);
    const auto known = made_.find(name);
    if (known != made_.end()) return known->second;
    const Pixels& pixels = pixelsOf(index);
    context_.files.guard().addPixels(pixels.values.size(), context_.at("images", static_cast<size_t>(index)));
    std::vector<Rgb> changed;
    changed.reserve(pixels.values.size());
    for (glm::vec4 pixel : pixels.values) {
        if (code == PixelCode::srgb)
            for (int c = 0; c < 3; ++c) pixel[c] = decodeSrgb(pixel[c]);
        const glm::dvec3 value = change(pixel);
        changed.push_back({static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)});
    }
    const Rgb first = changed.front();
    const bool isConstant = std::all_of(changed.begin(), changed.end(), [&](const Rgb& pixel) {
        return pixel.r == first.r && pixel.g == first.g && pixel.b == first.b;
    });
    MadeImage& made = made_[name];
    if (isConstant)
        made.value = {first.r, first.g, first.b};
    else {
        made.name = name;
        context_.parts.images[name] = {pixels.width, pixels.height, std::move(changed), 0};
    }
    return made;
}

} // namespace quasilux
