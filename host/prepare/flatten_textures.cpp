// Textures, their texels, and texture coordinates of the shapes that have some.
#include "prepare/device_scene.h"
#include "scene/color.h"
#include "scene/textures/texture_use.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

namespace quasilux {

namespace {

std::vector<unsigned> texturesInUse(const Scene& scene, const MaterialTables& materials,
                                    const EmitterTables& emitters) {
    std::vector<unsigned> used;
    for (const auto& lobe : materials.lobes)
        for (const unsigned number :
             {lobe.reflectanceTexture, lobe.transmittanceTexture, lobe.etaTexture, lobe.kTexture})
            if (number > 0) used.push_back(number - 1);
    for (const auto& weight : materials.weights) used.push_back(weight.texture);
    for (const auto& relief : materials.reliefs) used.push_back(relief.texture);
    for (const auto& levels : materials.roughness)
        for (const unsigned number : levels.texture)
            if (number > 0) used.push_back(number - 1);
    for (const auto& emitter : emitters.emitters)
        if (emitter.texture > 0) used.push_back(emitter.texture - 1);
    return withNested(scene, used);
}

void appendColor(Rgb color, std::vector<uint32_t>& words) {
    for (const float channel : {color.r, color.g, color.b}) words.push_back(std::bit_cast<uint32_t>(channel));
}

/// Of the mesh the attribute that the texture shows, as the kernels read it.
void appendAttribute(const TextureDescription& texture, const Mesh& mesh, std::vector<uint32_t>& words) {
    const auto shown =
        std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                     [&](const MeshAttribute& attribute) { return attribute.name == texture.attribute; });
    const auto append = [&](size_t index) {
        const Rgb value = shown->values.at(index) * texture.attributeScale;
        const float most = texture.use == TextureUse::reflectance ? 1.0f : std::numeric_limits<float>::max();
        appendColor({std::min(value.r, most), std::min(value.g, most), std::min(value.b, most)}, words);
    };
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (shown->isOfFaces())
            append(t);
        else
            for (glm::length_t corner = 0; corner < 3; ++corner) append(mesh.triangles[t][corner]);
    }
}

/// Adds the attributes that the texture of this index shows. Returns where it is said in which word those of a shape
/// begin.
unsigned appendAttributes(unsigned index, const Scene& scene, std::vector<uint32_t>& words) {
    const size_t directory = words.size();
    words.resize(directory + scene.shapes.size(), QL_NONE);
    for (size_t k = 0; k < scene.shapes.size(); ++k) {
        const ShapeDescription& shape = scene.shapes[k];
        if (shape.mesh.attributes.empty()) continue;
        const auto shown = texturesOf(scene, shape);
        if (std::find(shown.begin(), shown.end(), index) == shown.end()) continue;
        words[directory + k] = static_cast<uint32_t>(words.size());
        appendAttribute(scene.textures[index], shape.mesh, words);
    }
    return static_cast<unsigned>(directory);
}

/// Appends a volume and returns its word.
unsigned appendShownVolume(const VolumeDescription& volume, std::vector<uint32_t>& words) {
    constexpr size_t recordWords = sizeof(shared::VolumeGrid) / sizeof(uint32_t);
    const size_t first = words.size();
    shared::VolumeGrid record = volume.device;
    record.firstValue = recordWords;
    words.resize(first + recordWords);
    std::memcpy(words.data() + first, &record, sizeof(record));
    for (const float value : volume.values) words.push_back(std::bit_cast<uint32_t>(value));
    return static_cast<unsigned>(first);
}

} // namespace

TextureTables flattenTextures(const Scene& scene, const MaterialTables& materials, const EmitterTables& emitters) {
    TextureTables tables;
    for (const TextureDescription& texture : scene.textures) tables.textures.push_back(texture.device);
    std::map<const void*, unsigned> placed; // images that several textures share, by Texels::identity
    size_t texelCount = 0;
    std::map<const VolumeDescription*, unsigned> volumes;
    for (const unsigned k : texturesInUse(scene, materials, emitters)) {
        shared::Texture& record = tables.textures[k];
        const Texels& texels = scene.textures[k].texels;
        tables.areNested |= record.texture0 > 0 || record.texture1 > 0;
        if (!scene.textures[k].attribute.empty()) {
            record.firstTexel = appendAttributes(k, scene, tables.attributes);
            tables.haveAttributes = true;
            continue;
        }
        if (scene.textures[k].volume) {
            const VolumeDescription* volume = scene.textures[k].volume.get();
            if (!volumes.count(volume)) volumes[volume] = appendShownVolume(*volume, tables.attributes);
            record.firstTexel = volumes[volume];
            tables.haveVolumes = true;
            continue;
        }
        const auto [image, isNew] = placed.emplace(texels.identity(), static_cast<unsigned>(texelCount));
        record.firstTexel = image->second;
        if (!isNew) continue;
        tables.images.push_back(texels);
        texelCount += texels.size();
    }
    return tables;
}

bool hasUvLayers(const Scene& scene) {
    return std::any_of(scene.aovs.begin(), scene.aovs.end(), [](const AovLayer& layer) {
        switch (layer.quantity) {
        case AovQuantity::uv:
        case AovQuantity::dp_du:
        case AovQuantity::dp_dv:
        case AovQuantity::duv_dx:
        case AovQuantity::duv_dy:
            return true;
        default:
            return false;
        }
    });
}

/// Anisotropic lobes lie along u where the shape has it.
bool usesTexCoords(const Scene& scene, const Bsdf& bsdf) { return needsTexCoords(scene, bsdf) || bsdf.isAnisotropic(); }

unsigned uvWords(const Scene& scene, const ShapeDescription& shape) {
    const bool isShown = hasUvLayers(scene) ||
                         (shape.emitter && shape.emitter->texture && needTexCoords(scene, {*shape.emitter->texture}));
    if (!isShown && (shape.bsdf < 0 || !usesTexCoords(scene, scene.bsdfs[static_cast<size_t>(shape.bsdf)]))) return 0;
    return shape.sphere ? 9u : static_cast<unsigned>(2 * shape.mesh.cornerUvs.size());
}

std::vector<float> flattenUvs(const Scene& scene) {
    std::vector<float> words;
    for (const auto& shape : scene.shapes) {
        if (uvWords(scene, shape) == 0) continue;
        for (int row = 0; shape.sphere && row < 3; ++row)
            for (int column = 0; column < 3; ++column) words.push_back(shape.sphere->toLocal[column][row]);
        for (const glm::vec2& uv : shape.mesh.cornerUvs) {
            words.push_back(uv.x);
            words.push_back(uv.y);
        }
    }
    return words;
}

} // namespace quasilux
