#include "scene/textures/texture_use.h"

#include "scene/xml/names.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_set>

namespace quasilux {

namespace {

bool isAttribute(const TextureDescription& texture) { return !texture.attribute.empty(); }

Names namesOf(const std::vector<MeshAttribute>& attributes) {
    Names names;
    for (const MeshAttribute& attribute : attributes) names.push_back(attribute.name);
    return names;
}

const MeshAttribute& findAttribute(const ShapeDescription& shape, const std::string& name) {
    const auto& all = shape.mesh.attributes;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const MeshAttribute& attribute) { return attribute.name == name; });
    if (found != all.end()) return *found;
    const std::string known = all.empty() ? "It has none; those of the vertices and faces of PLY files are read."
                                          : fmt::format("It has: {}.", joinNames(namesOf(all)));
    throw InputError(shape.where,
                     fmt::format("shape '{}' has no attribute '{}', which a texture of its bsdf or emitter shows. {}",
                                 shape.id, name, known));
}

const char* ruleOf(TextureUse use) {
    switch (use) {
    case TextureUse::emission:
        return "radiance is at least 0";
    case TextureUse::index:
        return "indices of refraction are at least 0";
    case TextureUse::height: // only of bitmaps
    case TextureUse::reflectance:
        break;
    }
    return "reflectances lie within [0, 1]";
}

/// Throws InputError for values that the texture's use does not allow, warns of reflectances that are too large.
void checkValues(const ShapeDescription& shape, const MeshAttribute& attribute, const TextureDescription& texture,
                 LoadContext& context) {
    const float scale = texture.attributeScale;
    const bool bounded = texture.use == TextureUse::reflectance;
    size_t above = 0;
    for (size_t k = 0; k < attribute.values.size(); ++k) {
        const Rgb& value = attribute.values[k];
        for (const float channel : {scale * value.r, scale * value.g, scale * value.b})
            if (!std::isfinite(channel) || channel < 0)
                throw InputError(shape.where,
                                 fmt::format("attribute '{}' of shape '{}', times the texture's scale, is {} at {} {}; "
                                             "{}.",
                                             attribute.name, shape.id, channel,
                                             attribute.isOfFaces() ? "triangle" : "vertex", k, ruleOf(texture.use)));
        above += bounded && scale * std::max({value.r, value.g, value.b}) > 1;
    }
    if (above == 0 || !context.brightAttributes.insert(fmt::format("{} {} {}", shape.id, attribute.name, scale)).second)
        return;
    context.warn(shape.where,
                 fmt::format("{} of the {} values of attribute '{}' are above 1 and are taken as 1. Colours from 0 to "
                             "255 need <float name=\"scale\" value=\"0.00392157\"/> in the texture.",
                             above, attribute.values.size(), attribute.name));
}

} // namespace

std::vector<unsigned> withNested(const Scene& scene, const std::vector<unsigned>& textures) {
    std::vector<unsigned> all;
    std::unordered_set<unsigned> known; // there may be thousands
    const auto add = [&](unsigned index) {
        if (known.insert(index).second) all.push_back(index);
    };
    for (const unsigned index : textures) add(index);
    for (size_t k = 0; k < all.size(); ++k) {
        const shared::Texture& texture = scene.textures[all[k]].device;
        for (const unsigned number : {texture.texture0, texture.texture1})
            if (number > 0) add(number - 1);
    }
    return all;
}

bool needsTexCoords(const Scene& scene, const Bsdf& bsdf) {
    return bsdf.frontRelief || bsdf.backRelief || needTexCoords(scene, bsdf.textures());
}

bool needTexCoords(const Scene& scene, const std::vector<unsigned>& textures) {
    const std::vector<unsigned> shown = withNested(scene, textures);
    return std::any_of(shown.begin(), shown.end(), [&](unsigned index) {
        return !isAttribute(scene.textures[index]) && !scene.textures[index].volume;
    });
}

std::vector<unsigned> texturesOf(const Scene& scene, const ShapeDescription& shape) {
    std::vector<unsigned> all = scene.bsdfs[static_cast<size_t>(shape.bsdf)].textures();
    if (shape.emitter && shape.emitter->texture) all.push_back(*shape.emitter->texture);
    return withNested(scene, all);
}

void keepShownAttributes(ShapeDescription& shape, LoadContext& context) {
    const Scene& scene = context.scene;
    std::vector<MeshAttribute> kept;
    for (const unsigned index : texturesOf(scene, shape)) {
        const TextureDescription& texture = scene.textures[index];
        if (!isAttribute(texture)) continue;
        const MeshAttribute& attribute = findAttribute(shape, texture.attribute);
        if (texture.isNumber && attribute.channels != 1)
            throw InputError(shape.where, fmt::format("attribute '{}' of shape '{}' has {} channels, but a number is "
                                                      "wanted of it; use an attribute of one channel.",
                                                      attribute.name, shape.id, attribute.channels));
        checkValues(shape, attribute, texture, context);
        const auto same = [&](const MeshAttribute& other) { return other.name == attribute.name; };
        if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(attribute);
    }
    shape.mesh.attributes = std::move(kept);
}

} // namespace quasilux
