// Bsdfs into materials and lobes.
#include "prepare/device_scene.h"
#include "prepare/roughness_levels.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

unsigned appendSide(const Bsdf& bsdf, const std::vector<LobeDescription>& side,
                    const std::vector<LobeDecision>& decisions, MaterialTables& tables) {
    if (side.size() > LOBES_MOST)
        throw InputError(bsdf.where, fmt::format("this bsdf has {} lobes on one side, expected at most {}: blend fewer",
                                                 side.size(), LOBES_MOST));
    for (size_t k = 0; k < side.size(); ++k) {
        shared::Lobe lobe = side[k].device;
        lobe.scattering = decisions[k].scattering;
        lobe.firstWeight = static_cast<unsigned>(tables.weights.size());
        lobe.weightCount = static_cast<unsigned>(side[k].weights.size());
        tables.weights.insert(tables.weights.end(), side[k].weights.begin(), side[k].weights.end());
        tables.lobes.push_back(lobe);
    }
    return static_cast<unsigned>(side.size());
}

/// As in Material: appends the side's lobes again for all levels of their roughness but the first, whose place they
/// have.
unsigned appendRoughness(const Scene& scene, const Bsdf& bsdf, const std::vector<LobeDescription>& side, unsigned first,
                         MaterialTables& tables) {
    const auto levels = roughnessLevels(scene, bsdf, side);
    if (!levels) return 0;
    const std::vector<shared::Lobe> plain(tables.lobes.begin() + first, tables.lobes.end());
    tables.lobes.resize(first);
    for (unsigned k = 0; k < levels->count(); ++k)
        for (size_t i = 0; i < side.size(); ++i) tables.lobes.push_back(levels->lobeAt(k, plain[i], side[i]));
    tables.roughness.push_back(levels->device);
    return static_cast<unsigned>(tables.roughness.size());
}

/// As in Material.
unsigned appendRelief(const std::optional<shared::Relief>& relief, MaterialTables& tables) {
    if (!relief) return 0;
    tables.reliefs.push_back(*relief);
    return static_cast<unsigned>(tables.reliefs.size());
}

} // namespace

MaterialTables flattenMaterials(const Scene& scene, const std::vector<BsdfDecision>& split) {
    MaterialTables tables;
    for (size_t k = 0; k < scene.bsdfs.size(); ++k) {
        const auto& bsdf = scene.bsdfs[k];
        shared::Material material{};
        material.flags = (bsdf.isNull ? MATERIAL_NULL : 0) | (bsdf.isAnisotropic() ? MATERIAL_ANISOTROPIC : 0);
        material.frontFirst = static_cast<unsigned>(tables.lobes.size());
        material.frontCount = appendSide(bsdf, bsdf.front, split[k].front, tables);
        material.frontRoughness = appendRoughness(scene, bsdf, bsdf.front, material.frontFirst, tables);
        material.backFirst = static_cast<unsigned>(tables.lobes.size());
        material.backCount = appendSide(bsdf, bsdf.back, split[k].back, tables);
        material.backRoughness = appendRoughness(scene, bsdf, bsdf.back, material.backFirst, tables);
        material.frontRelief = appendRelief(bsdf.frontRelief, tables);
        material.backRelief = appendRelief(bsdf.backRelief, tables);
        tables.materials.push_back(material);
    }
    return tables;
}

} // namespace quasilux
