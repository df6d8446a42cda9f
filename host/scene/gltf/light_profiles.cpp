#include "scene/gltf/light_profiles.h"

#include "scene/gltf/accessors.h"
#include "scene/gltf/json_values.h"

#include <algorithm>

namespace quasilux {

namespace {

constexpr const char* lightsExtension = "EXT_lights_ies";

/// "a%20b" is "a b".
std::string withoutPercents(const std::string& uri) {
    const auto digit = [](char c) {
        const size_t value =
            std::string_view("0123456789abcdef").find(static_cast<char>(c >= 'A' && c <= 'F' ? c + 32 : c));
        return value == std::string_view::npos ? -1 : static_cast<int>(value);
    };
    std::string text;
    for (size_t k = 0; k < uri.size(); ++k) {
        const bool isCode = uri[k] == '%' && k + 2 < uri.size() && digit(uri[k + 1]) >= 0 && digit(uri[k + 2]) >= 0;
        text += isCode ? static_cast<char>(16 * digit(uri[k + 1]) + digit(uri[k + 2])) : uri[k];
        if (isCode) k += 2;
    }
    return text;
}

std::string contentOfDataUri(const std::string& uri, const SourceLocation& where) {
    const size_t comma = uri.find(',');
    if (comma == std::string::npos) throw InputError(where, "the data URI has no comma, after which its data begin.");
    const std::string data = uri.substr(comma + 1);
    if (uri.substr(0, comma).find(";base64") == std::string::npos) return withoutPercents(data);
    std::vector<unsigned char> bytes;
    std::string mimeType;
    // tinygltf decodes data of the types that it knows.
    if (!tinygltf::DecodeDataURI(&bytes, mimeType, "data:text/plain;base64," + data, 0, false))
        throw InputError(where, "the data URI is no base64.");
    return {bytes.begin(), bytes.end()};
}

/// The file's name, or that under which its content is kept.
std::string filenameOf(GltfContext& context, const GltfValues& profile, size_t index, const SourceLocation& where) {
    const std::string uri = profile.text("uri");
    const int view = profile.index("bufferView");
    if (uri.empty() == (view < 0))
        throw InputError(where, "expected either 'uri' or 'bufferView', which holds the IES file.");
    if (view < 0 && uri.compare(0, 5, "data:") != 0) return withoutPercents(uri);
    std::string name = fmt::format("{}: {}.lights[{}]", context.path, lightsExtension, index);
    std::string& content = context.parts.goniograms[name];
    if (!content.empty()) return name;
    if (view >= 0) {
        const GltfBytes bytes = bytesOfView(context, view, where);
        content.assign(bytes.data, bytes.data + bytes.size);
    } else
        content = contentOfDataUri(uri, where);
    return name;
}

} // namespace

std::optional<LightProfile> lightProfileOf(GltfContext& context, const tinygltf::Node& node,
                                           const SourceLocation& where) {
    const GltfValues light(node.extensions, lightsExtension, where);
    if (!light.isGiven()) return {};
    const int index = light.index("light");
    const SourceLocation all = context.at(lightsExtension);
    const tinygltf::Value* const list = GltfValues(context.model.extensions, lightsExtension, all).find("lights");
    const size_t count = list && list->IsArray() ? list->ArrayLen() : 0;
    if (index < 0 || static_cast<size_t>(index) >= count)
        throw InputError(where, fmt::format("{}.lights[{}] does not exist; the file has {} of them.", lightsExtension,
                                            index, count));
    const SourceLocation place = context.at(fmt::format("{}.lights", lightsExtension), static_cast<size_t>(index));
    LightProfile profile;
    profile.filename = filenameOf(context, GltfValues(&list->Get(index), place), static_cast<size_t>(index), place);
    profile.multiplier = light.numberWithin("multiplier", 1, 0, 1e12);
    profile.color = glm::clamp(light.triple("color", glm::dvec3(1)), 0.0, 1.0);
    return profile;
}

} // namespace quasilux
