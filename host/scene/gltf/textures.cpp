#include "scene/gltf/textures.h"

#include "scene/gltf/elements.h"
#include "scene/gltf/json_values.h"

#include <cmath>

namespace quasilux {

namespace {

constexpr const char* transformName = "KHR_texture_transform";

std::string wrapOf(int wrap, const SourceLocation& where) {
    switch (wrap) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return "repeat";
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return "mirror";
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return "clamp";
    default:
        throw InputError(where, fmt::format("unknown wrap mode {}; expected 10497, 33071 or 33648.", wrap));
    }
}

/// Texture coordinates are turned about the origin, counter-clockwise on an image whose v runs down, after they are
/// scaled and before they are moved.
std::optional<glm::dmat4> transformOf(const tinygltf::TextureInfo& texture, const SourceLocation& where) {
    const GltfValues values(texture.extensions, transformName, where);
    if (!values.isGiven()) return std::nullopt;
    const glm::dvec2 offset = values.pair("offset", {0, 0}), scale = values.pair("scale", {1, 1});
    const double angle = values.number("rotation", 0), c = std::cos(angle), s = std::sin(angle);
    glm::dmat4 matrix(1);
    matrix[0] = {c * scale.x, -s * scale.x, 0, 0};
    matrix[1] = {s * scale.y, c * scale.y, 0, 0};
    matrix[3] = {offset.x, offset.y, 0, 1};
    return matrix;
}

/// Whether a <transform> of the scene language may have it.
bool isRegularUv(const glm::dmat4& matrix) { return std::abs(glm::determinant(glm::dmat3(matrix))) > 1e-12; }

} // namespace

int GltfTextures::texCoordOf(const tinygltf::TextureInfo& texture, const SourceLocation& where) {
    const int instead = GltfValues(texture.extensions, transformName, where).index("texCoord");
    return instead >= 0 ? instead : texture.texCoord;
}

int GltfTextures::imageOf(const tinygltf::TextureInfo& texture, const SourceLocation& where) const {
    const tinygltf::Texture& found = gltfEntry(context_.model.textures, "textures", texture.index, where);
    const SourceLocation place = context_.at("textures", static_cast<size_t>(texture.index));
    if (found.source < 0)
        throw InputError(place, "the texture has no image ('source') in PNG or JPEG; export it with one.");
    gltfEntry(context_.model.images, "images", found.source, place);
    return found.source;
}

GltfParameter GltfTextures::make(const tinygltf::TextureInfo& texture, PixelCode code, const std::string& meaning,
                                 const PixelChange& change, const SourceLocation& where) {
    const MadeImage image = images_.make(imageOf(texture, where), code, meaning, change);
    if (image.isConstant()) return {image.value, {}};

    const int index = context_.model.textures[static_cast<size_t>(texture.index)].sampler;
    const SourceLocation place = context_.at("textures", static_cast<size_t>(texture.index));
    const tinygltf::Sampler sampler =
        index < 0 ? tinygltf::Sampler() : gltfEntry(context_.model.samplers, "samplers", index, place);
    const bool isNearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    const std::string wrap = wrapOf(sampler.wrapS, place);
    if (wrapOf(sampler.wrapT, place) != wrap)
        context_.withoutEffect.insert("wrapT of samplers, where it is not as wrapS");
    std::optional<glm::dmat4> toUv = transformOf(texture, where);
    if (toUv && !isRegularUv(*toUv)) {
        context_.withoutEffect.insert("texture transforms that scale by 0");
        toUv.reset();
    }

    Element element = newObject("texture", "bitmap", "", place);
    addText(element, "filename", image.name);
    addFlag(element, "raw", true);
    addText(element, "filter_type", isNearest ? "nearest" : "bilinear");
    addText(element, "wrap_mode", wrap);
    std::string key = fmt::format("{} {} {}", image.name, isNearest, wrap);
    if (toUv) {
        addMatrix(element, "to_uv", *toUv);
        key += element.children.back().children[0].get("value");
    }
    std::string& id = ids_[key];
    if (id.empty()) {
        id = context_.newId(fmt::format("textures[{}] {}", texture.index, meaning), "");
        element.attributes.push_back({"id", id});
        scene_.children.push_back(std::move(element));
    }
    return {{}, id};
}

} // namespace quasilux
