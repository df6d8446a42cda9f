// Textures, their texels, and texture coordinates of the shapes that have some.
#include "prepare/device_scene.h"

#include <algorithm>
#include <map>

namespace quasilux {

namespace {

std::vector<bool> texturesInUse(const Scene& scene, const MaterialTables& materials, const EmitterTables& emitters) {
    std::vector<bool> used(scene.textures.size() + 1); // [0]: of lobes and emitters that have none
    for (const auto& lobe : materials.lobes) used[lobe.reflectanceTexture] = used[lobe.transmittanceTexture] = true;
    for (const auto& weight : materials.weights) used[weight.texture + 1] = true;
    for (const auto& relief : materials.reliefs) used[relief.texture + 1] = true;
    for (const auto& emitter : emitters.emitters) used[emitter.texture] = true;
    used.erase(used.begin());
    return used;
}

} // namespace

TextureTables flattenTextures(const Scene& scene, const MaterialTables& materials, const EmitterTables& emitters) {
    const std::vector<bool> used = texturesInUse(scene, materials, emitters);
    TextureTables tables;
    std::map<const void*, unsigned> placed; // images that several textures share, by Texels::identity
    for (unsigned k = 0; k < scene.textures.size(); ++k) {
        shared::Texture record = scene.textures[k].device;
        const Texels& texels = scene.textures[k].texels;
        if (used[k]) {
            const auto [image, isNew] = placed.emplace(texels.identity(), static_cast<unsigned>(tables.texels.size()));
            record.firstTexel = image->second;
            if (isNew) tables.texels.insert(tables.texels.end(), texels.begin(), texels.end());
        }
        tables.textures.push_back(record);
    }
    return tables;
}

unsigned uvWords(const Scene& scene, const ShapeDescription& shape) {
    if (shape.bsdf < 0 || !scene.bsdfs[static_cast<size_t>(shape.bsdf)].isTextured()) return 0;
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
